// SPDX-License-Identifier: Apache-2.0
#include "armature/report/effort.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace armature::report {
namespace {

constexpr std::string_view kJointsData = ".jointsDataPort[";
constexpr std::string_view kVoltage = ".VoltageActuator";

std::optional<double> last_value(const Signals& signals, const std::string& name) {
  const Signal* const signal = signals.find(name);
  if (signal == nullptr || signal->values.empty()) return std::nullopt;
  return signal->values.back();
}

Effort make_effort(std::string joint, const Signal& signal, std::optional<double> limit) {
  Effort effort{std::move(joint), signal, 0.0, limit};
  for (const double value : signal.values) {
    if (std::isfinite(value)) effort.largest = std::max(effort.largest, std::abs(value));
  }
  return effort;
}

/// `Wam.MaxTorque[2]`, or one for all: `Wam.MaxTorque[0]`.
std::optional<double> torque_limit(const Signals& signals, const std::string& component,
                                   std::size_t joint) {
  const std::string name = component + ".MaxTorque";
  const bool for_each = signals.find(name + "[1]") != nullptr;
  return last_value(signals, name + '[' + std::to_string(for_each ? joint : 0) + ']');
}

/// The last third of the elements.
std::vector<Effort> torques(const Signals& signals) {
  std::string component;
  std::vector<const Signal*> elements;
  for (const Signal& signal : signals.all) {
    const std::size_t port = signal.name.find(kJointsData);
    if (port == std::string::npos) continue;
    if (component.empty()) component = signal.name.substr(0, port);
    if (signal.name.compare(0, port, component) == 0) elements.push_back(&signal);
  }
  std::vector<Effort> efforts;
  const std::size_t count = elements.size() / 3;
  for (std::size_t joint = 0; joint < count; ++joint) {
    efforts.push_back(make_effort(std::to_string(joint + 1), *elements[2 * count + joint],
                                  torque_limit(signals, component, joint)));
    efforts.back().signal.unit = "Nm";
  }
  return efforts;
}

std::vector<Effort> voltages(const Signals& signals) {
  std::vector<Effort> efforts;
  for (const Signal& signal : signals.all) {
    const std::string_view name = signal.name;
    if (!name.starts_with("Joint") || !name.ends_with(kVoltage)) continue;
    const std::string component(name.substr(0, name.size() - kVoltage.size()));
    efforts.push_back(make_effort(component.substr(std::string_view("Joint").size()), signal,
                                  last_value(signals, component + ".MaxVoltage")));
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
