// SPDX-License-Identifier: Apache-2.0
#include "armature/report/effort.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace armature::report {
namespace {

constexpr std::string_view kJointsData = ".jointsDataPort";
constexpr std::string_view kVoltage = ".VoltageActuator";

Effort make_effort(std::string joint, const Signal& signal, std::optional<double> limit) {
  Effort effort{std::move(joint), signal, 0.0, limit};
  for (const double value : signal.values) {
    if (std::isfinite(value)) effort.largest = std::max(effort.largest, std::abs(value));
  }
  return effort;
}

/// The last third of the elements.
std::vector<Effort> torques(const Signals& signals) {
  const std::vector<const Signal*> elements = elements_of_port(signals, std::string(kJointsData));
  if (elements.empty()) return {};
  const std::string& first = elements.front()->name;
  const std::string component = first.substr(0, first.find(kJointsData));
  std::vector<Effort> efforts;
  const std::size_t count = elements.size() / 3;
  for (std::size_t joint = 0; joint < count; ++joint) {
    efforts.push_back(make_effort(std::to_string(joint + 1), *elements[2 * count + joint],
                                  limit_in(signals, component + ".MaxTorque", joint)));
    efforts.back().signal.unit = "Nm";
  }
  return efforts;
}

std::vector<Effort> voltages(const Signals& signals) {
  std::vector<Effort> efforts;
  for (const Signal& signal : signals.all) {
    const std::string_view name = signal.name;
    if (!name.ends_with(kVoltage)) continue;
    const std::string component(name.substr(0, name.size() - kVoltage.size()));
    const std::optional<std::string> joint = joint_named(component);
    if (!joint) continue;
    efforts.push_back(make_effort(*joint, signal, limit_in(signals, component + ".MaxVoltage", 0)));
  }
  std::sort(efforts.begin(), efforts.end(),
            [](const Effort& a, const Effort& b) { return before_by_number(a.joint, b.joint); });
  return efforts;
}

}  // namespace

std::vector<Effort> efforts_of(const Signals& signals) {
  std::vector<Effort> efforts = torques(signals);
  return efforts.empty() ? voltages(signals) : efforts;
}

}  // namespace armature::report
