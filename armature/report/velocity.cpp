// SPDX-License-Identifier: Apache-2.0
#include "armature/report/velocity.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace armature::report {
namespace {

constexpr const char* kUnit = "rad/s";
constexpr const char* kData = ".jointsDataPort";

/// Over the sample before and the one behind: what an encoder's counts add is halved.
Signal slope_of(const std::vector<double>& time_s, const std::vector<double>& position) {
  Signal slope{{}, kUnit, "slope of the position", {}, {}};
  for (std::size_t i = 1; i + 1 < time_s.size(); ++i) {
    const double span_s = time_s[i + 1] - time_s[i - 1];
    slope.time_s.push_back(time_s[i]);
    slope.values.push_back(span_s > 0.0 ? (position[i + 1] - position[i - 1]) / span_s
                                        : std::numeric_limits<double>::quiet_NaN());
  }
  return slope;
}

/// The element of this joint in the second third of a vector [q, qd, ...]; nullptr: there is none.
const Signal* second_third(const std::vector<const Signal*>& elements, std::size_t joint) {
  const std::size_t joints = elements.size() / 3;
  return joint < joints ? elements[joints + joint] : nullptr;
}

Signal as_velocity(const Signal& signal) {
  Signal velocity = signal;
  velocity.unit = kUnit;
  return velocity;
}

/// The place in vectors of a joint that is called by its number; else that among those found.
std::size_t place_of(const Joint& joint, std::size_t among) {
  std::size_t number = 0;
  const char* const end = joint.name.data() + joint.name.size();
  const auto [rest, failure] = std::from_chars(joint.name.data(), end, number);
  return failure == std::errc() && rest == end && number > 0 ? number - 1 : among;
}

double largest_of(const Signal& signal) {
  double largest = 0.0;
  for (const double value : signal.values) {
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  }
  return largest;
}

std::optional<double> velocity_limit(const Signals& signals, const std::string& joint,
                                     std::size_t index,
                                     const std::vector<const Signal*>& joints_data) {
  if (const auto own = limit_in(signals, "Joint" + joint + ".MaxVelocity", 0)) return own;
  if (joints_data.empty()) return std::nullopt;
  const std::string& name = joints_data.front()->name;
  return limit_in(signals, name.substr(0, name.find(kData)) + ".MaxVelocity", index);
}

}  // namespace

std::vector<Velocity> velocities_of(const Signals& signals, const std::vector<Joint>& joints) {
  const std::vector<const Signal*> references = elements_of_port(signals, ".reference");
  const std::vector<const Signal*> joints_data = elements_of_port(signals, kData);
  std::vector<Velocity> velocities;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const Joint& joint = joints[i];
    const std::size_t place = place_of(joint, i);
    const Signal* const desired = second_third(references, place);
    const Signal* const measured = second_third(joints_data, place);
    Velocity velocity{
        joint.name,
        desired != nullptr ? as_velocity(*desired) : slope_of(joint.time_s, joint.desired),
        measured != nullptr ? as_velocity(*measured) : slope_of(joint.time_s, joint.measured), 0.0,
        velocity_limit(signals, joint.name, place, joints_data)};
    velocity.largest = largest_of(velocity.measured);
    velocities.push_back(std::move(velocity));
  }
  return velocities;
}

}  // namespace armature::report
