// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/controllers/axes_generator/axes_generator.hpp"
#include "armature/testing/harness.hpp"

namespace armature::controllers {

using Vector = std::vector<double>;

/// A generator of two axes; what is measured is what the test says.
class AxesGenerator : public ::testing::Test {
 protected:
  AxesGenerator() : AxesGenerator(std::make_unique<AxesGeneratorPos>("Generator")) {}
  explicit AxesGenerator(std::unique_ptr<component::Component> made)
      : generator(std::move(made), std::chrono::milliseconds(10)) {
    set_limits(2);
  }
  void set_limits(int axes) {
    generator.set("num_axes", axes);
    generator.set("max_vel", "[1.0]");
    generator.set("max_acc", "[2.0]");
    generator.set("lower", "[-0.5]");
    generator.set("upper", "[4.5]");
  }
  void start_at(const Vector& positions) {
    measured = positions;
    ASSERT_TRUE(generator.start()) << generator.reason();
    cycle();
  }
  virtual void cycle(int count = 1) {
    for (int i = 0; i < count; ++i) {
      generator.write("nAxesSensorPosition", measured);
      generator.run_cycles();
    }
  }
  std::string refusal_of(const Vector& positions, double time) {
    const auto answer = generator.call("moveTo", positions, time);
    return answer ? "accepted" : answer.error();
  }
  const Vector& desired() { return generator.output<Vector>("nAxesDesiredPosition"); }
  const Vector& velocity() { return generator.output<Vector>("nAxesDesiredVelocity"); }
  const Vector& acceleration() { return generator.output<Vector>("nAxesDesiredAcceleration"); }

  Vector measured{0.25, 0.5};
  testing::Harness generator;
};

/// With an Arming among its peers.
class OfAnArmedRobot : public AxesGenerator {
 protected:
  OfAnArmedRobot() {
    generator.serve<bool()>("isArmed", [this] { return armed; });
    start_at({0.25, 0.5});
  }
  bool armed = false;
};

}  // namespace armature::controllers
