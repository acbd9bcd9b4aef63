// SPDX-License-Identifier: Apache-2.0
#include "robots/rover/ball.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "armature/base/seconds.hpp"
#include "robots/rover/numbers.hpp"

namespace armature::rover {
namespace {

constexpr double kMostX = 2.9;  // [m] of the ball's middle, between the walls
constexpr double kMostY = 1.9;
constexpr double kBehind = 1.0;  // [m]

}  // namespace

component::Outcome Ball::on_start() {
  reached_ = time();
  path_.emplace(BallPoint{begin_x_, begin_y_, kBallRadius});
  go(way_);
  point_.write(path_->at());
  return component::accepted();
}

void Ball::on_update() {
  const auto x = x_.read();
  const auto y = y_.read();
  if (x && y) {
    path_->move_to(std::clamp(x.value, -kMostX, kMostX), std::clamp(y.value, -kMostY, kMostY));
  }
  path_->step(base::to_seconds(time() - std::exchange(reached_, time())));
  point_.write(path_->at());
}

void Ball::go(BallWay way) {
  if (path_) path_->go(way, {.speed = speed_, .carry_to = behind_the_rover()});
}

BallPoint Ball::behind_the_rover() {
  const auto place = place_.read();
  if (!place) return {kBeginX, 0.0, kBallRadius};
  const Place& rover = place.value;
  return {std::clamp(rover.x - kBehind * std::cos(rover.heading), -kMostX, kMostX),
          std::clamp(rover.y - kBehind * std::sin(rover.heading), -kMostY, kMostY), kBallRadius};
}

}  // namespace armature::rover
