// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/driver/driven_watch.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "robots/wam/internal/number_text.hpp"
#include "robots/wam/internal/shaking.hpp"

namespace armature::wam {
namespace {

using component::Reason;
using control::HoldingWatch;

/// [rad/s] Beyond the largest velocity, which the limiter keeps with a little overshoot.
constexpr double kOvershoot = 0.3;
/// [rad/s] Slower, a joint neither sinks nor is driven.
constexpr double kRestsBelow = 0.02;
/// [s] So long without sinking is a break: a hand makes one, a weight does not.
constexpr double kBreak = 0.5;
/// [N m] Less pulls no joint down against its friction.
constexpr double kLeastWeight = 0.5;
/// [s] From a cycle until what it decides makes the tip slower.
constexpr double kReaction = 0.012;

Reason reason_of(std::size_t joint, std::string_view what, double measured, std::string_view unit,
                 double bound) {
  Reason why("joint ");
  internal::append_number(why, static_cast<double>(joint + 1)).append(what);
  internal::append_number(why, measured).append(unit).append(", expected at most ");
  return internal::append_number(why, bound);
}

}  // namespace

base::Result<DrivenWatch> DrivenWatch::make(const Config& config) {
  std::vector<Joint> joints;
  for (std::size_t i = 0; i < config.max_velocity.size(); ++i) {
    HoldingWatch::Config shaking =
        internal::shaking_config(config.period_s, config.max_torque[i], config.max_alternation);
    shaking.max_motion = config.max_driven;
    shaking.max_velocity = shaking.rest_velocity = config.max_velocity[i];
    auto made = HoldingWatch::make(shaking);
    if (!made) return base::Error{"joint " + std::to_string(i + 1) + ": " + made.error()};
    joints.push_back({.shaking = std::move(made).value()});
  }
  return DrivenWatch(config, std::move(joints));
}

void DrivenWatch::begin() {
  rests_ = false;
  tip_.fill(0.0);
  for (Joint& joint : joints_) {
    joint.shaking.move();
    joint.shaking.stand();
    joint.fast_cycles = 0;
  }
}

void DrivenWatch::rest() {
  if (!std::exchange(rests_, true)) placed_ = false;
}

std::optional<Reason> DrivenWatch::step(const Measured& measured) {
  if (rests_ && !std::exchange(placed_, true)) {
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      joints_[i].place = measured.positions[i];
      joints_[i].sunk = joints_[i].pause_s = 0.0;
      joints_[i].driven_cycles = 0;
    }
  }
  const double tip = predict_tip(measured.tip);
  if (!(tip <= config_.max_tip)) {
    Reason why("the tip gets too fast: ");
    internal::append_number(why, tip).append(" m/s, expected at most ");
    return internal::append_number(why, config_.max_tip);
  }
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    if (auto why = judge(i, measured)) return why;
  }
  return std::nullopt;
}

/// [m/s] At the time when braking takes effect, if it goes on as in the last cycles.
double DrivenWatch::predict_tip(double speed) {
  tip_[next_tip_] = speed;
  next_tip_ = (next_tip_ + 1) % tip_.size();
  double earlier = 0.0;
  double lately = 0.0;
  for (std::size_t age = 0; age < tip_.size(); ++age) {
    const double each = tip_[(next_tip_ + age) % tip_.size()] / kMean;
    (age < kMean ? earlier : lately) += each;
  }
  constexpr double kBehind = (kMean - 1) / 2.0;  // cycles that a mean is behind
  const double growth = (lately - earlier) / (kMean * config_.period_s);
  return lately + std::max(growth, 0.0) * (kBehind * config_.period_s + kReaction);
}

std::optional<Reason> DrivenWatch::judge(std::size_t index, const Measured& measured) {
  Joint& joint = joints_[index];
  const double speed = std::abs(measured.velocities[index]);
  const double most = config_.max_velocity[index] + kOvershoot;
  joint.fast_cycles = speed <= most ? 0 : joint.fast_cycles + 1;  // also what is no number
  if (joint.fast_cycles >= HoldingWatch::kFastSteps) {
    return reason_of(index, " is too fast: ", speed, " rad/s", most);
  }
  const auto shaking = joint.shaking.judge_effort(measured.torques[index]);
  if (shaking.is_alarm()) {
    return reason_of(index, " shakes: what drives it has changed its sign in ", shaking.measured,
                     " of the cycles", shaking.bound);
  }
  return rests_ ? judge_standing(index, measured) : std::nullopt;
}

/// What a torque moves away from its place it drives; what moves down without one sinks, unless a
/// hand does it, which stops now and then.
std::optional<Reason> DrivenWatch::judge_standing(std::size_t index, const Measured& measured) {
  Joint& joint = joints_[index];
  const double velocity = measured.velocities[index];
  const double torque = measured.torques[index];
  const double weight = measured.weight[index];
  const double off = measured.positions[index] - joint.place;
  const bool moves = std::abs(velocity) > kRestsBelow;
  const bool driven = moves && torque * velocity > 0.0 &&
                      std::abs(torque) > internal::kLeastDriving * config_.max_torque[index];
  const bool away = std::abs(off) > config_.max_driven && velocity * off > 0.0;
  joint.driven_cycles = driven && away ? joint.driven_cycles + 1 : 0;
  if (joint.driven_cycles >= HoldingWatch::kFastSteps) {
    return reason_of(index, " should stand still but is driven away: by ", std::abs(off), " rad",
                     config_.max_driven);
  }
  const bool may_sink = moves && !driven && std::abs(weight) > kLeastWeight;
  const double down = may_sink ? -std::copysign(velocity, velocity * weight) : 0.0;
  joint.pause_s = down > 0.0 ? 0.0 : joint.pause_s + config_.period_s;
  joint.sunk = std::max(0.0, joint.sunk + down * config_.period_s);
  if (joint.pause_s >= kBreak) joint.sunk = 0.0;
  if (joint.sunk <= config_.max_sinking) return std::nullopt;
  return reason_of(index, " sinks, and nothing drives it down: by ", joint.sunk, " rad",
                   config_.max_sinking);
}

}  // namespace armature::wam
