// SPDX-License-Identifier: Apache-2.0
#include "armature/report/effort.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace armature::report {
namespace {

constexpr std::string_view kTorque = ".torque[";
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

/// `Wam.jointsDataPort.torque[0]` -> the limit of the first joint of `Wam`.
std::optional<double> torque_limit(const Signals& signals, const std::string& signal,
                                   std::size_t joint) {
  const std::string limit = signal.substr(0, signal.find('.')) + ".MaxTorque";
  const auto own = last_value(signals, limit + '[' + std::to_string(joint) + ']');
  if (own) return own;
  // One for all.
  return signals.find(limit + "[1]") == nullptr ? last_value(signals, limit + "[0]") : std::nullopt;
}

std::vector<Effort> torques(const Signals& signals) {
  std::vector<Effort> efforts;
  std::string port;
  for (const Signal& signal : signals.all) {
    const std::size_t field = signal.name.find(kTorque);
    if (field == std::string::npos) continue;
    if (port.empty()) port = signal.name.substr(0, field);
    if (signal.name.compare(0, field, port) != 0) continue;
    const std::size_t joint = efforts.size();
    efforts.push_back(
        make_effort(std::to_string(joint + 1), signal, torque_limit(signals, signal.name, joint)));
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
