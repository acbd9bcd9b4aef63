// SPDX-License-Identifier: Apache-2.0
// A deployment in simulated time, for campaigns of what breaks in it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "armature/deploy/deployment.hpp"
#include "armature/testing/deployed_robot.hpp"

namespace armature::campaign {

using Vector = std::vector<double>;

inline double largest_apart(const Vector& left, const Vector& right) {
  double most = 0.0;
  for (std::size_t i = 0; i < left.size(); ++i) most = std::max(most, std::abs(left[i] - right[i]));
  return most;
}

/// A deployment with the libraries of this build, whose black box is written by the test.
class DeployedRobot : public testing::DeployedRobot {
 public:
  using WriteBlackBox = std::function<std::string(const exec::BlackBoxReport&)>;

  DeployedRobot(const std::string& file, std::vector<std::string> overrides,
                WriteBlackBox write_black_box)
      : testing::DeployedRobot(load(file, std::move(overrides), std::move(write_black_box))) {}

  /// Does not wait for its end. Answers why not: nothing if it was begun.
  std::string move_to(const Vector& positions, double time) {
    target_ = positions;
    return call("Generator", "moveTo", {types::Value::of(positions), types::Value::of(time)});
  }
  /// Of the last motion.
  const Vector& target() const { return target_; }

 private:
  static deploy::Deployment load(const std::string& file, std::vector<std::string> overrides,
                                 WriteBlackBox write_black_box) {
    deploy::DeploymentOptions options;
    options.library_folders = {LIBRARIES};
    options.document.overrides = std::move(overrides);
    deploy::Deployment deployment = deploy::load_deployment(file, options);
    deployment.options.black_box.write = std::move(write_black_box);
    return deployment;
  }

  Vector target_;
};

}  // namespace armature::campaign
