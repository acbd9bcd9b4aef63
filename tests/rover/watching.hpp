// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "robots/rover/ball_path.hpp"
#include "robots/rover/following.hpp"
#include "tests/rover/rover.hpp"

namespace armature::rover {

/// The rover with its control program, in simulated time, watched at each image.
class Watched {
 public:
  explicit Watched(std::vector<std::string> overrides = {}, const char* file = "rover.yaml")
      : robot(std::string(ROVER "/deployments/") + file, std::move(overrides)) {}

  void start() { robot.start_armed(); }
  void go(BallWay way) {
    const auto done = robot.application().call("Ball", "go", {types::Value::of(way)});
    ASSERT_TRUE(done) << done.error();
  }
  void turn(double by) {
    const Place at = robot.plant().place();
    const auto done = robot.application().call(
        "Rover", "put",
        {types::Value::of(at.x), types::Value::of(at.y), types::Value::of(at.heading + by)});
    ASSERT_TRUE(done) << done.error();
  }
  /// What was seen, image by image.
  std::vector<Sight> watch(base::Duration duration) {
    std::vector<Sight> sights;
    for (base::Duration past{}; past < duration; past += kImage) {
      robot.run_for(kImage);
      time_s_ += 0.05;
      Sight sight;
      sight.time_s = time_s_;
      sight.view = robot.value<View>("Camera", "View");
      sight.judged = true;
      if (robot.value<bool>("Vision", "Seen")) {
        sight.seen =
            PicturePoint{robot.value<double>("Vision", "X"), robot.value<double>("Vision", "Y")};
      }
      sights.push_back(sight);
    }
    return sights;
  }
  /// Until its wheels stand still, at most 5 s [s].
  double time_to_rest() {
    double past = 0.0;
    while (past < 5.0 && !robot.rests()) {
      robot.run_for(std::chrono::milliseconds(10));
      past += 0.01;
    }
    return past;
  }
  double fastest() { return std::max(std::abs(robot.speed(0)), std::abs(robot.speed(1))); }

  Robot robot;

 private:
  static constexpr base::Duration kImage = std::chrono::milliseconds(50);
  double time_s_ = 0.0;
};

}  // namespace armature::rover
