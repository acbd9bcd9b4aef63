// SPDX-License-Identifier: Apache-2.0
// The pucks of the WAM on its emulated bus, with its safety board.
#include "armature/testing/drive_conformance.hpp"
#include "robots/wam/emulator/emulator_command.hpp"
#include "robots/wam/wam_hardware.hpp"

namespace armature::testing {
namespace {

wam::WamHardware& wam_of(exec::Application& application) {
  return static_cast<wam::WamHardware&>(*application.find("WAM"));
}
wam::Emulator& emulator_of(exec::Application& application) {
  return wam_of(application).emulated()->emulator();
}

void have_keys_pressed(exec::Application& application, bool pressed) {
  static_cast<void>(
      application.set_property("WAM", "emulated_operator", types::Value::of(pressed)));
}
/// The operator resets the safety circuit and presses Activate, until the arm holds itself.
void activate(exec::Application& application) {
  have_keys_pressed(application, true);
  const auto holds = [&] {
    return wam_of(application).torque_path().mode() == wam::TorquePath::Mode::kHolding;
  };
  for (int k = 0; k < 2000 && !holds(); ++k) application.run_for(std::chrono::milliseconds(2));
  have_keys_pressed(application, false);
}

void tell_emulator(exec::Application& application, const std::string& command) {
  const auto parsed = wam::parse_emulator_command(command, 7);
  ASSERT_TRUE(parsed) << parsed.error();
  parsed.value().apply(
      {emulator_of(application), wam_of(application).emulated()->motors(), wam::wam7()});
}

DriveCase::Joints positions_of(exec::Application& application) {
  DriveCase::Joints all;
  for (std::size_t i = 0; i < 7; ++i) {
    all.push_back(wam_of(application).emulated()->motors().arm().joint_position(i));
  }
  return all;
}

void pass_until(exec::Application& application, base::Time time) {
  if (emulator_of(application).now() < time) emulator_of(application).advance_to(time);
}

DriveCase arm(const std::string& file) {
  return {
      .name = file,
      .file = WAM "/deployments/" + file + ".yaml",
      .library_folders = {LIBRARIES},
      .hardware = {"WAM"},
      .away = {0.5, -1.5, 0.3, 2.5, 0.3, 0.3, 0.3},
      .motion_time = 4.0,
      .brakes_within = 3.5,    // the wrist, from 7 rad/s with its MaxAcceleration
      .sinks = 0.1,            // its motors are braked, and have no brakes
      .stops_at_once = false,  // it moves home
      .begins_again = true,
      .prepare = activate,
      .positions = positions_of,
      .time = [](exec::Application& application) { return emulator_of(application).now(); },
      .pass = pass_until,
      .silence =
          [](exec::Application& application) { tell_emulator(application, "fault puck 2 silent"); },
      .fail = [](exec::Application& application) { tell_emulator(application, "estop"); },
      .mend =
          [](exec::Application& application) {
            tell_emulator(application, "fault puck 2 heals");
            tell_emulator(application, "release");
            tell_emulator(application, "home");
            have_keys_pressed(application, true);
          }};
}

INSTANTIATE_TEST_SUITE_P(Wam, DriveConformance, ::testing::Values(arm("npid7"), arm("gravity_pd7")),
                         by_name);

}  // namespace
}  // namespace armature::testing
