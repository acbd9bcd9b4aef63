// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/torque_path.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "armature/base/seconds.hpp"

namespace armature::wam {
namespace {

using control::JointLimiter;

/// Of each cycle's torque in the mean of the last ten or so.
constexpr double kSettling = 0.1;
/// Of the time of a hand-over: some ten cycles.
constexpr double kLearning = 0.05;

bool all_finite(std::span<const double> numbers) {
  return std::ranges::all_of(numbers, [](double number) { return std::isfinite(number); });
}

base::Result<void> check(const TorquePath::Config& config, std::size_t joints) {
  const auto expect = [&](const char* name, const std::vector<double>& numbers) -> std::string {
    if (numbers.size() != joints) {
      return std::string(name) + " has " + std::to_string(numbers.size()) + " numbers, expected " +
             std::to_string(joints);
    }
    for (const double number : numbers) {
      if (std::isfinite(number) && number > 0.0) continue;
      return std::string(name) + " has " + std::to_string(number) + ", expected above 0";
    }
    return "";
  };
  for (const std::string& mistake :
       {expect("MaxTorque", config.max_torque), expect("MaxTorqueGrowth", config.max_growth)}) {
    if (!mistake.empty()) return base::Error{mistake};
  }
  if (config.hold.size() != joints || config.limits.size() != joints) {
    return base::Error{"gains and limits are of another number of joints than " +
                       std::to_string(joints)};
  }
  return {};
}

}  // namespace

base::Result<TorquePath> TorquePath::make(const Config& config, control::Transmission transmission,
                                          control::InverseDynamics links) {
  const std::size_t joints = transmission.joints();
  if (const auto checked = check(config, joints); !checked) return base::Error{checked.error()};
  auto holder = JointController::make({.gains = config.hold, .period_s = config.period_s});
  if (!holder) return base::Error{holder.error()};
  auto brake = control::ReferenceBrake::make({.joints = joints,
                                              .max_acceleration = config.max_acceleration,
                                              .period = base::from_seconds(config.period_s)});
  if (!brake) return base::Error{brake.error()};
  for (std::size_t i = 0; i < joints; ++i) {
    const auto limiter = JointLimiter::check(config.limits[i]);
    if (!limiter) return base::Error{"joint " + std::to_string(i + 1) + ": " + limiter.error()};
  }
  return TorquePath(config, std::move(transmission), std::move(links), std::move(holder).value(),
                    std::move(brake).value());
}

TorquePath::TorquePath(const Config& config, control::Transmission transmission,
                       control::InverseDynamics links, JointController holder,
                       control::ReferenceBrake brake)
    : config_(config),
      transmission_(std::move(transmission)),
      links_(std::move(links)),
      holder_(std::move(holder)),
      brake_(std::move(brake)) {
  const std::size_t joints = transmission_.joints();
  for (const JointLimiter::Config& limits : config_.limits) {
    limiters_.push_back(JointLimiter::make(limits).value());
  }
  hand_over_ = control::HandOver(joints);
  motion_.assign(3 * joints, 0.0);
  for (auto* numbers :
       {&positions_, &velocities_, &weight_, &driving_, &settled_, &torques_, &motors_}) {
    numbers->assign(joints, 0.0);
  }
}

void TorquePath::measure(std::span<const double> positions, std::span<const double> velocities) {
  finite_ = all_finite(positions) && all_finite(velocities);
  measured_anew_ = true;
  if (!finite_) return;
  std::ranges::copy(positions, positions_.begin());
  std::ranges::copy(velocities, velocities_.begin());
  links_.gravity(positions_, weight_);
}

void TorquePath::go_off() {
  mode_ = Mode::kOff;
  for (JointLimiter& limiter : limiters_) limiter.disarm();
  hand_over_.reset();
  for (auto* numbers : {&driving_, &torques_, &motors_}) std::ranges::fill(*numbers, 0.0);
}

void TorquePath::begin_to_hold(Last driven) {
  if (driven == Last::kEndsAtOnce) {
    hand_over_.reset();
    std::ranges::fill(driving_, 0.0);
  } else if (mode_ == Mode::kDriven) {
    hand_over_.begin(driving_);
  }
  mode_ = Mode::kHolding;
  for (JointLimiter& limiter : limiters_) limiter.disarm();
  std::ranges::copy(positions_, motion_.begin());
  std::ranges::copy(velocities_, motion_.begin() + static_cast<std::ptrdiff_t>(joints()));
  brake_.begin(motion_);
  measured_anew_ = false;
  settled_ = driving_;
  holder_.reset();
}

bool TorquePath::begin_to_drive() {
  if (mode_ != Mode::kHolding || !finite_) return false;
  for (std::size_t i = 0; i < joints(); ++i) limiters_[i].arm({positions_[i], velocities_[i]});
  if (hand_over_.active()) {
    hand_over_.begin(driving_);
  } else {
    hand_over_.begin(settled_, kLearning);
  }
  mode_ = Mode::kDriven;
  return true;
}

void TorquePath::step_hold(base::Time now) {
  const std::vector<double>& reference = measured_anew_ ? brake_.step() : motion_;
  holder_.step(std::span(reference).first(joints()), positions_, driving_);
  send(now);
  for (std::size_t i = 0; i < joints(); ++i) {
    settled_[i] += kSettling * (driving_[i] - settled_[i]);
  }
}

bool TorquePath::begin_to_float() {
  if (mode_ != Mode::kHolding || !finite_) return false;
  hand_over_.begin(driving_);
  mode_ = Mode::kWeightless;
  return true;
}

void TorquePath::step_float(base::Time now) {
  std::ranges::fill(driving_, 0.0);
  send(now);
}

std::size_t TorquePath::first_over_limit(std::span<const double> command) const {
  for (std::size_t i = 0; i < joints(); ++i) {
    const double moving = config_.command_has_weight ? command[i] - weight_[i] : command[i];
    const bool over = std::abs(moving) > config_.limits[i].max_effort ||
                      std::abs(moving + weight_[i]) > config_.max_torque[i];
    if (over) return i;
  }
  return joints();
}

TorquePath::Result TorquePath::step_drive(std::span<const double> command, base::Time now) {
  if (config_.over_limit == OverLimit::kRefuseAll && first_over_limit(command) < joints()) {
    return Result::kRefused;
  }
  Result result = Result::kPassed;
  for (std::size_t i = 0; i < joints(); ++i) {
    const double moving = config_.command_has_weight ? command[i] - weight_[i] : command[i];
    const auto step =
        limiters_[i].step_effort({positions_[i], velocities_[i]}, finite_ ? moving : std::nan(""));
    driving_[i] = step.value;
    if (step.status == JointLimiter::Status::kNotFinite) result = Result::kNotFinite;
    if (step.status == JointLimiter::Status::kClipped && result == Result::kPassed) {
      result = Result::kClipped;
    }
  }
  if (result == Result::kClipped) ++clipped_;
  send(now);
  return result;
}

void TorquePath::send(base::Time now) {
  hand_over_.step(driving_, now, config_.hand_over);
  for (std::size_t i = 0; i < joints(); ++i) {
    const double most = config_.max_torque[i];
    const double growth = config_.max_growth[i];
    const double wanted = std::clamp(driving_[i] + weight_[i], -most, most);
    torques_[i] = std::clamp(wanted, std::min(torques_[i], 0.0) - growth,
                             std::max(torques_[i], 0.0) + growth);
  }
  transmission_.motor_torques(torques_, motors_);
}

}  // namespace armature::wam
