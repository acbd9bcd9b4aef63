// SPDX-License-Identifier: Apache-2.0
// Drives by CiA 402, emulated, in each mode.
#include "armature/testing/drive_conformance.hpp"
#include "drives/cia402_components/emulated_cia402_bus.hpp"

namespace armature::testing {
namespace {

cia402::EmulatedBus& drives_of(exec::Application& application) {
  return static_cast<cia402::EmulatedCia402Bus*>(application.find("Bus"))->drives();
}

DriveCase::Joints positions_of(exec::Application& application) {
  return {drives_of(application).drive(0).axis().position(),
          drives_of(application).drive(1).axis().position()};
}

void pass_until(exec::Application& application, base::Time time) {
  cia402::EmulatedBus& drives = drives_of(application);
  while (drives.bus().now() < time) {
    drives.advance_to(std::min(time, drives.bus().now() + std::chrono::microseconds(50)));
  }
}

bool powered(exec::Application& application) {
  return drives_of(application).drive(0).power() == cia402::PowerState::kOperationEnabled ||
         drives_of(application).drive(1).power() == cia402::PowerState::kOperationEnabled;
}

void mend(exec::Application& application) {
  for (std::size_t i = 0; i < 2; ++i) drives_of(application).drive(i).set_deaf_to_sync(false);
  for (int node = 1; node <= 2; ++node) {
    static_cast<void>(application.call("Bus", "resetDrive", {types::Value::of(node)}));
  }
}

DriveCase drive_by(const std::string& mode) {
  return {
      .name = mode,
      .file = EXAMPLES "/12_cia402/" + mode + ".yaml",
      .library_folders = {LIBRARIES},
      .hardware = {"Bus", "Drive1", "Drive2"},
      .away = {1.0, -0.8},
      .positions = positions_of,
      .powered = powered,
      .time = [](exec::Application& application) { return drives_of(application).bus().now(); },
      .pass = pass_until,
      .silence =
          [](exec::Application& application) {
            for (std::size_t i = 0; i < 2; ++i) {
              drives_of(application).drive(i).set_deaf_to_sync(true);
            }
          },
      .fail = [](exec::Application& application) { drives_of(application).drive(1).fail(0x2310); },
      .mend = mend};
}

INSTANTIATE_TEST_SUITE_P(Cia402, DriveConformance,
                         ::testing::Values(drive_by("torque"), drive_by("velocity"),
                                           drive_by("position")),
                         by_name);

}  // namespace
}  // namespace armature::testing
