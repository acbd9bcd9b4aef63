// SPDX-License-Identifier: Apache-2.0
// Drives by CiA 402 as components: a host with emulated drives, and a drive whose host is a fake.
#include <chrono>
#include <memory>

#include "armature/testing/harness.hpp"
#include "drives/cia402_components/cia402_drive.hpp"
#include "drives/cia402_components/emulated_cia402_bus.hpp"
#include "drives/cia402_components/torque_watch.hpp"
#include "tests/realtime/expect_realtime.hpp"

namespace armature::cia402 {
namespace {

using component::State;

TEST(RealtimeCia402, Host) {
  testing::Harness host(std::make_unique<EmulatedCia402Bus>("Bus"));
  host.set("nodes", "[1, 2]");
  host.set("mode", "velocity");
  host.set("Period", 0.002);
  ASSERT_TRUE(host.start()) << host.reason();
  DriveSample sample;
  expect_realtime_on_bench("Cia402Host", [&] {
    host.advance(std::chrono::milliseconds(2));
    sample = host.call<DriveSample>("readDrive", 1).value();
    EXPECT_TRUE(host.call<bool>("makeDriveSafe", 2, true).value());
  });
  EXPECT_EQ(sample.power, static_cast<int>(PowerState::kSwitchOnDisabled));
  host.stop();
}

TEST(RealtimeCia402, Drive) {
  testing::Harness drive(std::make_unique<Cia402Drive>("Drive1"));
  DriveSample sample{.fresh = true, .power = static_cast<int>(PowerState::kOperationEnabled)};
  drive.serve<DriveSample(int)>("readDrive", [&](int) { return sample; });
  drive.serve<bool(int, control::LimitedEffort)>("setEffort", [](int, auto) { return true; });
  drive.serve<bool(int, control::LimitedVelocity)>("setVelocity", [](int, auto) { return true; });
  drive.serve<bool(int, control::LimitedPosition)>("setPosition", [](int, auto) { return true; });
  drive.serve<bool(int, bool, control::DrivePermit)>("energizeDrive",
                                                     [](int, bool, auto) { return true; });
  drive.serve<bool(int, bool)>("makeDriveSafe", [](int, bool) { return true; });
  ASSERT_TRUE(drive.start()) << drive.reason();
  int read = 0;
  expect_realtime_on_bench("Cia402Drive", [&] {
    sample.position += 0.001;
    read += drive.call<bool>("sensorRead").value() ? 1 : 0;
    drive.write("TorqueActuator", control::LimitedEffort());
    EXPECT_TRUE(drive.call<bool>("brakeApply").value());
    EXPECT_TRUE(drive.call<bool>("actuatorOff").value());
  });
  EXPECT_EQ(read, 100);
  EXPECT_NEAR(drive.output<double>("PositionSensor"), 0.1, 1e-9);
  sample.power = static_cast<int>(PowerState::kFault);
  sample.error_code = 0x2310;
  expect_realtime_on_bench("Cia402Drive",
                           [&] { static_cast<void>(drive.call<bool>("sensorRead")); });
  EXPECT_EQ(drive.state(), State::kException);
}

TEST(RealtimeCia402, TorqueWatch) {
  TorqueWatch watch;
  DriveState drive;
  drive.power = PowerState::kOperationEnabled;
  double target = 0.0;
  auto finding = TorqueWatch::Finding::kGood;
  expect_realtime("TorqueWatch::step", [&] {
    drive.time += std::chrono::milliseconds(2);
    finding = watch.step(drive, target += 0.1, 50.0);
  });
  EXPECT_EQ(finding, TorqueWatch::Finding::kDisobeys);
}

TEST(RealtimeCia402, AStatusWord) {
  DriveStatus status;
  expect_realtime("cia402_components::status_of", [&] { status = status_of(0x0237); });
  EXPECT_TRUE(status.operation_enabled);
}

}  // namespace
}  // namespace armature::cia402
