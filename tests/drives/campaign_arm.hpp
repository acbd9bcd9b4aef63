// SPDX-License-Identifier: Apache-2.0
// The arm of examples/12_cia402 with seven emulated drives, for what breaks in it.
#pragma once

#include <chrono>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "drives/cia402_components/emulated_cia402_bus.hpp"
#include "tests/campaign/deployed_robot.hpp"

namespace armature::cia402 {

using campaign::DeployedRobot;
using campaign::largest_apart;
using campaign::Vector;

/// The application in simulated time, and drives for which time passes also when nobody speaks to
/// them any more.
class CampaignArm final : public DeployedRobot {
 public:
  static constexpr base::Duration kPeriod = std::chrono::milliseconds(2);
  static constexpr std::size_t kJoints = 7;

  /// @param mode  `torque`, `velocity` or `position`
  explicit CampaignArm(const std::string& mode)
      : DeployedRobot(EXAMPLES "/12_cia402/" + mode + ".yaml",
                      {"joints=7", "nodes=[1, 2, 3, 4, 5, 6, 7]", "Bus.vendor=0x402"}, {}) {}

  /// @thread while its host is configured
  EmulatedCia402Bus& host() { return static_cast<EmulatedCia402Bus&>(*application().find("Bus")); }
  EmulatedBus& drives() { return host().drives(); }
  EmulatedDrive& drive(std::size_t joint) { return drives().drive(joint); }

  void start() {
    const auto started = application().start();
    ASSERT_TRUE(started.ok()) << started.to_text();
    application().run_for(std::chrono::milliseconds(1));  // one cycle in each period from then on
    run_for(std::chrono::milliseconds(100));
  }
  void arm() {
    const auto asked = application().begin("Arming", "arm", {});
    ASSERT_TRUE(asked) << asked.error();
    for (int i = 0; i < 5000 && !armed() && !asked.value().ended(); ++i) cycle();
    ASSERT_TRUE(armed()) << asked.value().reason() << "\n" << log;
  }
  /// The operator has looked where each joint is whose drive lost its power.
  void confirm_positions() {
    for (std::size_t joint = 1; joint <= kJoints; ++joint) {
      set(("Drive" + std::to_string(joint)).c_str(), "position_confirmed", true);
    }
  }
  /// One period of the application, and as much for the drives.
  void cycle() {
    const base::Time before = drives().bus().now();
    application().run_for(kPeriod);
    let_drives_run_until(before + kPeriod);
    if (looks) looks();
  }
  void run_for(base::Duration duration) {
    for (base::Duration passed{}; passed < duration; passed += kPeriod) cycle();
  }
  void let_drives_run_until(base::Time time) {
    while (drives().bus().now() < time) {
      drives().advance_to(std::min(time, drives().bus().now() + std::chrono::microseconds(50)));
    }
  }

  /// Where the joints really are [rad].
  Vector positions() {
    Vector all;
    for (std::size_t i = 0; i < kJoints; ++i) all.push_back(drive(i).axis().position());
    return all;
  }
  /// Of the fastest joint [rad/s].
  double fastest() {
    double most = 0.0;
    for (std::size_t i = 0; i < kJoints; ++i) {
      most = std::max(most, std::abs(drive(i).axis().velocity()));
    }
    return most;
  }
  /// Where the application believes them to be.
  Vector believed() {
    Vector all = value<Vector>("Sensor", "sensor");
    all.resize(kJoints);
    return all;
  }
  bool any_enabled() {
    for (std::size_t i = 0; i < kJoints; ++i) {
      if (drive(i).power() == PowerState::kOperationEnabled) return true;
    }
    return false;
  }
  /// Every reason of what is out of service.
  std::string reasons() {
    std::string all;
    for (const auto& entry : application().blueprint().components) {
      if (entry.component->state() != component::State::kException) continue;
      all += entry.component->name() + ": " + std::string(entry.component->reason()) + "\n";
    }
    return all;
  }

  std::function<void()> looks;  ///< of judges, after each cycle
};

}  // namespace armature::cia402
