// SPDX-License-Identifier: Apache-2.0
// A deployment of the arm on the emulated arm, for what breaks in it.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "robots/wam/emulator/emulator_command.hpp"
#include "robots/wam/wam_hardware.hpp"
#include "tests/campaign/deployed_robot.hpp"

namespace armature::wam {

using campaign::DeployedRobot;
using campaign::largest_apart;
using campaign::Vector;

/// The application in simulated time, and the arm for which time passes also when nobody asks it
/// for anything any more.
class CampaignArm final : public DeployedRobot {
 public:
  static constexpr base::Duration kPeriod = std::chrono::milliseconds(2);

  CampaignArm(const std::string& file, WriteBlackBox write_black_box)
      : DeployedRobot(WAM "/deployments/" + file, {}, std::move(write_black_box)) {}

  WamHardware& hardware() { return static_cast<WamHardware&>(*application().find("WAM")); }
  EmulatedLink& link() { return *hardware().emulated(); }
  Emulator& emulator() { return link().emulator(); }
  SafetyBoard& board() { return emulator().board(); }
  const ArmSimulation& simulated() { return link().motors().arm(); }
  std::size_t joints() { return emulator().motors(); }

  /// Up to an arm that is active and holds itself; from then on nobody presses keys but the test.
  void start_active() {
    const auto started = application().start();
    ASSERT_TRUE(started.ok()) << started.to_text();
    application().run_for(std::chrono::milliseconds(1));  // one cycle in each period from then on
    for (int i = 0; i < 500 && !holds(); ++i) cycle();
    ASSERT_TRUE(holds()) << log;
    ASSERT_EQ(safety_state(), "ACTIVATED");
    set("WAM", "emulated_operator", false);
  }
  void arm() {
    ASSERT_EQ(call("Arming", "arm"), "");
    for (int i = 0; i < 50 && !armed(); ++i) cycle();
    ASSERT_TRUE(armed()) << log;
  }
  /// One period of the application, and as much for the arm.
  void cycle() {
    const base::Time before = emulator().now();
    application().run_for(kPeriod);
    if (emulator().now() == before) emulator().advance_to(before + kPeriod);
  }

  /// The arm is driven by them, which is more than `armed`: that the operator lets it.
  bool passes_torques() { return hardware().torque_path().mode() == TorquePath::Mode::kDriven; }
  bool holds() { return hardware().torque_path().mode() == TorquePath::Mode::kHolding; }
  std::string safety_state() { return text("safety_state"); }
  std::string waits_for() { return text("waits_for"); }

  /// A command of the emulator, in which N stands for the puck.
  void tell_emulator(std::string command, int puck) {
    if (const auto n = command.find('N'); n != std::string::npos) {
      command.replace(n, 1, std::to_string(puck));
    }
    const auto parsed = parse_emulator_command(command, joints());
    ASSERT_TRUE(parsed) << parsed.error();
    parsed.value().apply({emulator(), link().motors(), numbers()});
  }
  const ArmNumbers& numbers() { return joints() == 4 ? wam4() : wam7(); }

  /// Where the joints really are [rad].
  Vector positions() {
    Vector all;
    for (std::size_t i = 0; i < joints(); ++i) all.push_back(simulated().joint_position(i));
    return all;
  }
  Vector believed() {
    Vector all = value<Vector>("Sensor", "sensor");
    all.resize(joints());
    return all;
  }
  bool any_puck_drives() {
    for (std::size_t i = 0; i < joints(); ++i) {
      const Puck& puck = emulator().puck(i);
      if (puck.state() == PuckState::kReady && puck.mode() != PuckMode::kIdle) return true;
    }
    return false;
  }

 private:
  std::string text(const char* attribute) {
    return std::string(value<component::Reason>("WAM", attribute).view());
  }
};

}  // namespace armature::wam
