// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/controllers/joint/joint.hpp"
#include "armature/testing/harness.hpp"

namespace armature::controllers {

/// A joint at 1 rad whose hardware notes what it is told.
class JointTest : public ::testing::Test {
 protected:
  JointTest() : JointTest(std::make_unique<Joint>("Joint1"), JointCommand::kVoltage) {}
  /// @param limit  of what the hardware is told
  JointTest(std::unique_ptr<component::Component> made, JointCommand way, double limit = 12.0)
      : joint(std::move(made)) {
    calls.reserve(10000);  // the hardware is called in real time
    joint.set("PeerName", "Card");
    joint.set("Brake", true);
    joint.set("GearRatio", 0.01);
    joint.set("InitialPos", 1.0);
    joint.set("PositionMin", -0.5);
    joint.set("PositionMax", 4.5);
    joint.set("MaxVelocity", 1.0);
    joint.set("MaxAcceleration", 5.0);
    joint.set(names_of(way).limit, limit);
    joint.set("Period", 0.01);
    joint.set("ArmingTime", 0.0);
    for (const char* name : {"actuatorOff", "brakeApply"}) {
      joint.serve<bool()>(name, [this, name] { return called(name); });
    }
    for (const char* name : {"actuatorOn", "brakeRelease"}) {
      joint.serve<bool(control::DrivePermit)>(name, [this, name](control::DrivePermit permit) {
        return called(permit ? name : "refused");
      });
    }
    // Connects it; before the start, so that it does not count.
    joint.write(names_of(way).command, 0.0);
    joint.serve<bool()>("sensorRead", [this] {
      calls.emplace_back("sensorRead");
      if (on_read) on_read();
      return true;
    });
  }
  bool called(std::string_view name) {
    calls.push_back(name);
    return name != broken;
  }
  /// A sampling period in which the motor's axis moved.
  void sample(double of_motor = 0.0) {
    joint.advance(std::chrono::milliseconds(10));
    joint.raise("Sample");
    joint.write("DisplacementSensor", of_motor);
  }
  void start() {
    ASSERT_TRUE(joint.start()) << joint.reason();
    sample();
    calls.clear();
  }
  void start_armed() {
    start();
    arm();
    ASSERT_TRUE(armed());
    calls.clear();
  }
  /// Until it is armed or has given up, with the voltage that the controller holds it with.
  void arm(double voltage = 0.0) {
    joint.raise("Arm");
    for (int k = 0; k < 400 && !armed() && joint.get<double>("arming_moved") < 0.01; ++k) {
      act(voltage);
      sample();
    }
  }
  /// The same until the brake is open.
  void arm_until_let_go(double voltage = 0.0) {
    joint.raise("Arm");
    for (int k = 0; k < 400 && commands().back() != "brakeRelease"; ++k) {
      act(voltage);
      sample();
    }
  }
  /// What the hardware was told, without readings.
  std::vector<std::string_view> commands() const {
    std::vector<std::string_view> told;
    for (const std::string_view call : calls) {
      if (call != "sensorRead") told.push_back(call);
    }
    return told;
  }
  /// What the hardware gets of `voltage`.
  double act(double voltage) {
    joint.write("Voltage", voltage);
    joint.raise("Act");
    return effort();
  }
  double effort() { return joint.output<control::LimitedEffort>("VoltageActuator"); }
  bool armed() { return joint.output<bool>("Armed"); }
  double position() { return joint.output<double>("Position"); }

  std::vector<std::string_view> calls;
  std::string_view broken;
  std::function<void()> on_read;  ///< what the hardware does at once
  testing::Harness joint;         ///< last: it stops its hardware
};

}  // namespace armature::controllers
