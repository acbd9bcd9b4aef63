// SPDX-License-Identifier: Apache-2.0
#include "robots/rover/ball_path.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "robots/rover/numbers.hpp"

namespace armature::rover {
namespace {

constexpr double kHalfLine = 1.0;      // [m]
constexpr double kRest = 2.0;          // [s]
constexpr double kCircleRadius = 1.5;  // [m]
constexpr double kEightX = 1.5;        // half its length [m]
constexpr double kEightY = 0.8;        // half its width [m]
constexpr double kCarrySpeed = 2.0;    // [m/s]
constexpr double kCarryHeight = 0.9;   // [m]
constexpr BallPoint kBesideScreen{2.45, -0.7, kBallRadius};
constexpr BallPoint kBehindScreen{2.45, 0.7, kBallRadius};

double distance(const BallPoint& a, const BallPoint& b) {
  return std::sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) +
                   (a.z - b.z) * (a.z - b.z));
}

}  // namespace

void BallPath::go(BallWay way, const Config& config) {
  config_ = config;
  way_ = way;
  begin_ = at_;
  rested_ = 0.0;
  angle_ = 0.0;
  phase_ = Phase::kRollThere;
  switch (way) {
    case BallWay::kLine:
      phase_ = Phase::kOnWay;
      target_ = {begin_.x + kHalfLine, begin_.y, kBallRadius};
      return;
    case BallWay::kCircle:
      angle_ = std::atan2(at_.y, at_.x);
      target_ = on_curve(angle_);
      return;
    case BallWay::kEight:
      target_ = on_curve(angle_);
      return;
    case BallWay::kHide:
      target_ = kBesideScreen;
      return;
    case BallWay::kCarry:
      phase_ = Phase::kLift;
      target_ = {at_.x, at_.y, kCarryHeight};
      return;
    case BallWay::kRest:
    case BallWay::kPorts:
      phase_ = Phase::kArrived;
  }
}

void BallPath::move_to(double x, double y) {
  if (way_ == BallWay::kPorts && std::isfinite(x) && std::isfinite(y)) at_ = {x, y, kBallRadius};
}

void BallPath::step(double dt) {
  const double length = config_.speed * dt;
  if (way_ == BallWay::kCarry) {
    step_carry(dt);
  } else if (phase_ == Phase::kRollThere) {
    if (!roll_towards(target_, length)) return;
    phase_ = Phase::kOnWay;
    if (way_ == BallWay::kHide) target_ = kBehindScreen;
  } else if (phase_ != Phase::kOnWay) {
    return;
  } else if (way_ == BallWay::kLine) {
    step_line(dt);
  } else if (way_ == BallWay::kHide) {
    roll_towards(target_, length);
  } else {
    step_curve(length);
  }
}

/// @return it is there
bool BallPath::roll_towards(const BallPoint& target, double length) {
  const double left = distance(at_, target);
  if (left <= length) {
    at_ = target;
    return true;
  }
  const double share = length / left;
  at_.x += share * (target.x - at_.x);
  at_.y += share * (target.y - at_.y);
  at_.z += share * (target.z - at_.z);
  return false;
}

void BallPath::step_line(double dt) {
  if (!roll_towards(target_, config_.speed * dt)) return;
  rested_ += dt;
  if (rested_ >= kRest) target_.x = begin_.x + 2.0 * kHalfLine;
}

BallPoint BallPath::on_curve(double angle) const {
  if (way_ == BallWay::kCircle) {
    return {kCircleRadius * std::cos(angle), kCircleRadius * std::sin(angle), kBallRadius};
  }
  return {kEightX * std::sin(angle), kEightY * std::sin(2.0 * angle), kBallRadius};
}

/// By so much angle as the length is, where the curve is now.
void BallPath::step_curve(double length) {
  const bool circle = way_ == BallWay::kCircle;
  const double along_x = circle ? kCircleRadius : kEightX * std::cos(angle_);
  const double along_y = circle ? 0.0 : 2.0 * kEightY * std::cos(2.0 * angle_);
  angle_ += length / std::sqrt(along_x * along_x + along_y * along_y);
  if (angle_ > std::numbers::pi) angle_ -= 2.0 * std::numbers::pi;
  at_ = on_curve(angle_);
}

void BallPath::step_carry(double dt) {
  if (phase_ == Phase::kArrived || !roll_towards(target_, kCarrySpeed * dt)) return;
  if (phase_ == Phase::kLift) {
    phase_ = Phase::kCarried;
    target_ = {config_.carry_to.x, config_.carry_to.y, kCarryHeight};
  } else if (phase_ == Phase::kCarried) {
    phase_ = Phase::kSetDown;
    target_.z = kBallRadius;
  } else {
    phase_ = Phase::kArrived;
  }
}

}  // namespace armature::rover
