// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/driver/standing_watch.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "robots/wam/internal/number_text.hpp"
#include "robots/wam/internal/shaking.hpp"

namespace armature::wam {
namespace {

using component::Reason;
using control::HoldingWatch;
using internal::append_number;

/// [s] Longer it does not take to come to rest, from the largest velocity on.
constexpr double kMostSettling = 1.5;
/// [s] So long at rest it stands: longer than what drove it before dies away by itself.
constexpr double kRest = 0.25;
/// [rad/s] Faster than at the beginning while motors take over from their brakes.
constexpr double kGive = 0.3;
/// Of the way on which a joint stops with MaxAcceleration: brakes begin late, and joints pull at
/// one another.
constexpr double kLongerWay = 2.0;
/// [s] at the first speed, before it becomes slower.
constexpr double kLateBrake = 0.1;
/// [rad] While motors take over from their brakes.
constexpr double kLeastWay = 0.05;

Reason reason_of(std::size_t joint, const HoldingWatch::Finding& finding) {
  Reason why("joint ");
  append_number(why, static_cast<double>(joint + 1));
  if (finding.verdict == HoldingWatch::Verdict::kAlternates) {
    why.append(" shakes: what holds it has changed its sign in ");
    append_number(why, finding.measured).append(" of the cycles");
  } else {
    why.append(" should stand still but has moved: by ");
    append_number(why, finding.measured);
    why.append(finding.verdict == HoldingWatch::Verdict::kFast ? " rad/s" : " rad");
  }
  append_number(why.append(", expected at most "), finding.bound);
  return why.append(
      ". Gains, gravity, masses or the period do not fit the arm, or the arm was pushed: it is "
      "braked and sinks; mend the cause, then reset, start, arm");
}

}  // namespace

base::Result<StandingWatch> StandingWatch::make(const Config& config) {
  std::vector<HoldingWatch> joints;
  for (std::size_t i = 0; i < config.max_motion.size(); ++i) {
    HoldingWatch::Config one =
        internal::shaking_config(config.period_s, config.max_torque[i], config.max_alternation);
    one.max_motion = config.max_motion[i];
    one.max_velocity = config.max_velocity[i];
    one.rest_velocity = config.max_velocity[i];
    auto made = HoldingWatch::make(one);
    if (!made) return base::Error{"joint " + std::to_string(i + 1) + ": " + made.error()};
    joints.push_back(std::move(made).value());
  }
  return StandingWatch(config, std::move(joints));
}

StandingWatch::StandingWatch(const Config& config, std::vector<HoldingWatch> joints)
    : config_(config),
      joints_(std::move(joints)),
      fast_cycles_(joints_.size(), 0),
      way_(joints_.size(), 0.0) {}

void StandingWatch::stand(std::span<const double> velocities) {
  if (phase_ != Phase::kMayMove) return;
  phase_ = Phase::kSettling;
  settling_s_ = at_rest_s_ = fastest_ = 0.0;
  std::ranges::fill(fast_cycles_, 0);
  std::ranges::fill(way_, 0.0);
  for (const double velocity : velocities) fastest_ = std::max(fastest_, std::abs(velocity));
  for (HoldingWatch& joint : joints_) joint.stand();
}

void StandingWatch::move() {
  phase_ = Phase::kMayMove;
  for (HoldingWatch& joint : joints_) joint.move();
}

std::optional<Reason> StandingWatch::step(std::span<const double> positions,
                                          std::span<const double> velocities,
                                          std::span<const double> torques) {
  if (phase_ == Phase::kMayMove) return std::nullopt;
  if (phase_ == Phase::kSettling) return settle(velocities, torques);
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const HoldingWatch::Finding finding = joints_[i].step({.position = positions[i],
                                                           .velocity = velocities[i],
                                                           .effort = torques[i],
                                                           .driven = true});
    if (finding.is_alarm()) return reason_of(i, finding);
  }
  return std::nullopt;
}

std::optional<Reason> StandingWatch::settle(std::span<const double> velocities,
                                            std::span<const double> torques) {
  bool rests = true;
  for (std::size_t i = 0; i < velocities.size(); ++i) {
    const HoldingWatch::Finding finding = judge_braking(i, std::abs(velocities[i]), torques[i]);
    if (finding.is_alarm()) return reason_of(i, finding);
    rests = rests && std::abs(velocities[i]) <= config_.max_velocity[i];
  }
  settling_s_ += config_.period_s;
  at_rest_s_ = rests ? at_rest_s_ + config_.period_s : 0.0;
  if (at_rest_s_ < kRest && settling_s_ < kMostSettling) return std::nullopt;
  phase_ = Phase::kStanding;
  for (HoldingWatch& joint : joints_) {
    joint.move();
    joint.stand();
  }
  return std::nullopt;
}

/// On its way to rest a joint becomes no faster than the fastest was, goes no farther than that one
/// needs to stop, and is not shaken.
HoldingWatch::Finding StandingWatch::judge_braking(std::size_t joint, double speed, double torque) {
  const double most = fastest_ + kGive;
  fast_cycles_[joint] = speed <= most ? 0 : fast_cycles_[joint] + 1;
  if (fast_cycles_[joint] >= HoldingWatch::kFastSteps) {
    return {HoldingWatch::Verdict::kFast, speed, most};
  }
  const double to_stop = fastest_ * fastest_ / (2.0 * config_.max_acceleration[joint]);
  const double way =
      config_.max_motion[joint] + kLeastWay + kLateBrake * fastest_ + kLongerWay * to_stop;
  way_[joint] += speed * config_.period_s;
  if (!(way_[joint] <= way)) return {HoldingWatch::Verdict::kMoved, way_[joint], way};
  return joints_[joint].judge_effort(torque);
}

}  // namespace armature::wam
