// SPDX-License-Identifier: Apache-2.0
#include "armature/control/taught/taught_player.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "armature/base/seconds.hpp"

namespace armature::control {
namespace {

constexpr double kRest = 1e-9;  ///< [rad/s, m/s]

std::vector<PathLimits> limits_of(const std::vector<OnlineTrajectory::Axis>& axes) {
  std::vector<PathLimits> limits;
  for (const auto& axis : axes) limits.push_back({axis.max_velocity, axis.max_acceleration});
  return limits;
}

std::size_t points_in(double seconds) {
  return static_cast<std::size_t>(std::ceil(seconds / kKnotSpacing_s)) + 4;
}

}  // namespace

std::string_view to_text(PlayRefusal refusal) {
  switch (refusal) {
    case PlayRefusal::kNone:
      return "accepted";
    case PlayRefusal::kWrongNumber:
      return "the motion has another number of joints, or is empty";
    case PlayRefusal::kTooLong:
      return "the motion is longer than max_duration";
    case PlayRefusal::kNotFinite:
      return "the motion has a number that is not finite";
    case PlayRefusal::kOutsideLimits:
      return "the motion leaves the limits of an axis";
    case PlayRefusal::kSpeed:
      return "the speed must be from 0.01 to 10";
    case PlayRefusal::kNoPosition:
      return "the present positions are no place to begin";
    case PlayRefusal::kElsewhere:
      return "the axes do not rest where the motion begins";
  }
  return "";
}

base::Result<TaughtPlayer> TaughtPlayer::make(const Config& config) {
  auto approach = OnlineTrajectory::make({config.axes});
  if (!approach) return base::Error{approach.error()};
  if (!(config.longest_s > 0.0) || config.longest_s > 3600.0) {
    return base::Error{"the longest motion must last more than 0 s and at most 3600 s"};
  }
  return TaughtPlayer(std::move(approach.value()), config);
}

TaughtPlayer::TaughtPlayer(OnlineTrajectory approach, const Config& config)
    : axes_(config.axes),
      approach_(std::move(approach)),
      path_(limits_of(config.axes), points_in(config.longest_s)),
      start_(axes_.size(), 0.0) {}

TaughtPlayer::Answer TaughtPlayer::check(std::span<const double> points, double speed) const {
  const std::size_t count = axes_.size();
  if (!(speed >= kSlowest && speed <= kFastest)) return {PlayRefusal::kSpeed};
  if (points.size() < 4 * count || points.size() % count != 0) return {PlayRefusal::kWrongNumber};
  if (points.size() / count > path_.capacity()) return {PlayRefusal::kTooLong};
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!std::isfinite(points[i])) return {PlayRefusal::kNotFinite, i % count, points[i]};
  }
  for (std::size_t knot = 0; knot + 3 < points.size() / count; ++knot) {
    for (std::size_t axis = 0; axis < count; ++axis) {
      for (const double place : taught_hull(points, count, knot, axis)) {
        if (place >= axes_[axis].lower && place <= axes_[axis].upper) continue;
        return {PlayRefusal::kOutsideLimits, axis, place};
      }
    }
  }
  return {};
}

TaughtPlayer::Answer TaughtPlayer::play_from_here(const OnlineTrajectory::State& state,
                                                  std::span<const double> points, double speed,
                                                  MotionLimit* whole) {
  if (const Answer answer = check(points, speed); !answer.accepted()) return answer;
  find_start(points);
  for (std::size_t axis = 0; axis < axes_.size(); ++axis) {
    const bool moves = !state.velocities.empty() && std::abs(state.velocities[axis]) > kRest;
    const bool here = std::abs(state.positions[axis] - start_[axis]) <= kHere;
    if (moves || !here) return {PlayRefusal::kElsewhere, axis, state.positions[axis]};
  }
  const Answer answer = play(state, points, speed, whole);
  if (answer.accepted()) rested_s_ = kSettling_s;
  return answer;
}

void TaughtPlayer::find_start(std::span<const double> points) {
  const SplineWeights weights = SplineWeights::at(0.0);
  for (std::size_t axis = 0; axis < axes_.size(); ++axis) {
    start_[axis] = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
      start_[axis] += weights.position[k] * points[k * axes_.size() + axis];
    }
  }
}

TaughtPlayer::Answer TaughtPlayer::play(const OnlineTrajectory::State& state,
                                        std::span<const double> points, double speed,
                                        MotionLimit* whole) {
  if (const Answer answer = check(points, speed); !answer.accepted()) return answer;
  find_start(points);
  whole_ = whole;
  if (!approach_.begin_at(state).accepted() ||
      !approach_.move_to({start_}, 0.0, whole_).accepted()) {
    let_go();
    return {PlayRefusal::kNoPosition};
  }
  path_.load(points, speed);
  stage_ = Stage::kApproach;
  stopping_ = false;
  on_path_last_ = false;
  passed_s_ = rested_s_ = progress_ = 0.0;
  return {};
}

void TaughtPlayer::step(base::Duration period) {
  if (stage_ == Stage::kIdle) return;
  passed_s_ += base::to_seconds(period);
  if (stage_ == Stage::kPath) {
    path_.step(base::to_seconds(period));
    if (path_.rests()) let_go();
  } else {
    approach_.step(period);
    const bool planned = stopping_ || path_.plan(whole_);
    if (!approach_.under_way()) rested_s_ += base::to_seconds(period);
    const bool settled = stopping_ || rested_s_ >= kSettling_s;
    if (!approach_.under_way() && settled && planned) begin_path();
  }
  progress_ = std::max(progress_, passed_share());
}

void TaughtPlayer::begin_path() {
  if (stopping_ || !path_.possible()) return let_go();
  path_.begin();
  stage_ = Stage::kPath;
  on_path_last_ = true;
}

void TaughtPlayer::stop() {
  stopping_ = true;
  if (stage_ == Stage::kApproach) approach_.stop();
  if (stage_ == Stage::kPath) path_.brake();
}

double TaughtPlayer::remaining_s() const {
  switch (stage_) {
    case Stage::kIdle:
      return 0.0;
    case Stage::kApproach:
      return approach_.remaining_s() +
             (stopping_ ? 0.0 : std::max(0.0, kSettling_s - rested_s_) + path_.duration_s());
    case Stage::kPath:
      return path_.remaining_s();
  }
  return 0.0;
}

double TaughtPlayer::passed_share() const {
  const double whole_s = passed_s_ + remaining_s();
  return whole_s > 0.0 ? passed_s_ / whole_s : 1.0;
}

/// Where it ended, once it has.
std::span<const double> TaughtPlayer::positions() const {
  return on_path_last_ ? path_.positions() : approach_.positions();
}

std::span<const double> TaughtPlayer::velocities() const {
  return on_path_last_ ? path_.velocities() : approach_.velocities();
}

std::span<const double> TaughtPlayer::accelerations() const {
  return on_path_last_ ? path_.accelerations() : approach_.accelerations();
}

}  // namespace armature::control
