// SPDX-License-Identifier: Apache-2.0
// Drives by CiA 402 in the cycle of their host.
#include <chrono>
#include <optional>
#include <utility>

#include <gtest/gtest.h>

#include "armature/base/diagnostic.hpp"
#include "armature/can/virtual_bus.hpp"
#include "drives/canopen/nmt.hpp"
#include "drives/cia402/background_sdo.hpp"
#include "drives/cia402/drive_group.hpp"
#include "drives/cia402/homing_run.hpp"
#include "drives/cia402/objects.hpp"
#include "tests/realtime/expect_realtime.hpp"

namespace armature::cia402 {
namespace {

using namespace std::chrono_literals;

TEST(RealtimeCia402, Homing) {
  HomingRun run(Mode::kCyclicPosition, true);
  HomingRun::Order order;
  expect_realtime("HomingRun::begin", [&] { static_cast<void>(run.begin()); });
  expect_realtime("HomingRun::step", [&] {
    order = run.step({.power = PowerState::kReadyToSwitchOn, .status = 0, .mode = 6});
  });
  EXPECT_EQ(order.mode, Mode::kHoming);
  expect_realtime("HomingRun::leave", [&] { run.leave(); });
}

TEST(RealtimeCia402, Power) {
  std::optional<PowerState> state;
  std::uint16_t word = 0;
  PowerCommand command{};
  expect_realtime("cia402::decode_status", [&] { state = decode_status(0x0237); });
  EXPECT_EQ(state, PowerState::kOperationEnabled);
  expect_realtime("cia402::encode_state", [&] { word = encode_state(*state); });
  expect_realtime("cia402::decode_control", [&] { command = decode_control(0x0f); });
  expect_realtime("cia402::encode_command", [&] { word = encode_command(command); });
  EXPECT_EQ(word, 0x0f);
  expect_realtime("cia402::next_command",
                  [&] { command = next_command(PowerState::kSwitchedOn, PowerGoal::kEnabled); });
  EXPECT_EQ(command, PowerCommand::kEnableOperation);
  PowerControl control;
  expect_realtime("PowerControl::set_goal", [&] { control.set_goal(PowerGoal::kEnabled); });
  expect_realtime("PowerControl::ask_reset", [&] { control.ask_reset(); });
  expect_realtime("PowerControl::step", [&] { word = control.step(PowerState::kSwitchedOn); });
  EXPECT_EQ(word, 0x0f);
  PowerMachine machine;
  machine.start();
  expect_realtime("PowerMachine::take_control", [&] { machine.take_control(0x06); });
  EXPECT_EQ(machine.state(), PowerState::kReadyToSwitchOn);
  expect_realtime("PowerMachine::fail", [&] { machine.fail(); });
  expect_realtime("PowerMachine::standing", [&] { machine.standing(); });
  EXPECT_EQ(machine.state(), PowerState::kFault);
}

TEST(RealtimeCia402, Scales) {
  const Scaling scaling =
      Scaling::make({.rated_torque_mNm = 500}, PositionUnit::kIncrements).value();
  double value = 0.0;
  std::int64_t raw = 0;
  expect_realtime("Scaling::position", [&] { value = scaling.position(7); });
  expect_realtime("Scaling::raw_position", [&] { raw = scaling.raw_position(value); });
  EXPECT_EQ(raw, 7);
  expect_realtime("Scaling::velocity", [&] { value = scaling.velocity(-7); });
  expect_realtime("Scaling::raw_velocity", [&] { raw = scaling.raw_velocity(value); });
  EXPECT_EQ(raw, -7);
  expect_realtime("Scaling::torque", [&] { value = scaling.torque(9); });
  expect_realtime("Scaling::raw_torque", [&] { raw = scaling.raw_torque(value); });
  EXPECT_EQ(raw, 9);
  expect_realtime("Scaling::current", [&] { value = scaling.current(1000); });
  EXPECT_NEAR(value, 0.001, 1e-12);
}

DriveGroup make_group() {
  DriveConfig config{
      .node = 1,
      .name = "J1",
      .mode = Mode::kCyclicPosition,
      .scaling = {},
      .receive = {{.cob_id = 0x201,
                   .valid = true,
                   .objects = {{object::kControlWord, 16}, {object::kTargetPosition, 32}}}},
      .transmit = {{.cob_id = 0x181,
                    .valid = true,
                    .objects = {{object::kStatusWord, 16}, {object::kPosition, 32}}}},
      .heartbeat_timeout = 100ms};
  return std::move(DriveGroup::make({config})).value();
}

TEST(RealtimeCia402, AGroupOfDrives) {
  base::Time now{};
  can::VirtualBus bus("can0", 1'000'000, [&] { return now; });
  can::VirtualStation& host = bus.add_station("host");
  can::VirtualStation& drive = bus.add_station("drive");
  base::Diagnostics diagnostics;
  ASSERT_TRUE(host.open({}, diagnostics) && drive.open({}, diagnostics));
  DriveGroup group = make_group();
  const can::Arrival answer{.frame = can::data_frame(0x181, {0x37, 0x02, 5, 0, 0, 0}), .time = now};
  expect_realtime("DriveGroup::take", [&] { group.take(answer); });
  EXPECT_TRUE(group.state(0).enabled());
  expect_realtime("DriveGroup::set_goal", [&] { group.set_goal(0, PowerGoal::kEnabled); });
  expect_realtime("DriveGroup::ask_reset", [&] { group.ask_reset(0); });
  expect_realtime("DriveGroup::set_halt", [&] { group.set_halt(0, true); });
  expect_realtime("DriveGroup::set_mode", [&] { group.set_mode(0, Mode::kHoming, false); });
  expect_realtime("DriveGroup::set_target", [&] { group.set_target(0, 8.0); });
  std::size_t refused = 1;
  expect_realtime("DriveGroup::step", [&] {
    group.take(answer);
    refused = group.step(host, now);
    bus.advance_to(now += 2ms);
  });
  EXPECT_EQ(refused, 0u);
  can::Arrival sent;
  ASSERT_EQ(drive.receive(sent), can::ReceiveStatus::kReceived);
  EXPECT_EQ(sent.frame, can::data_frame(0x201, {0x0f, 0x01, 8, 0, 0, 0}));
}

TEST(RealtimeCia402, WhatIsAskedBesideTheCycle) {
  base::Time now{};
  can::VirtualBus bus("can0", 1'000'000, [&] { return now; });
  can::VirtualStation& host = bus.add_station("host");
  can::VirtualStation& drive = bus.add_station("drive");
  base::Diagnostics diagnostics;
  ASSERT_TRUE(host.open({}, diagnostics) && drive.open({}, diagnostics));
  DriveConfig config = make_group().config(0);
  config.slow = {object::kCurrent};
  const DriveGroup group = std::move(DriveGroup::make({config})).value();
  BackgroundSdo background(group, 1ms);
  const can::Frame current = can::data_frame(0x581, {0x4b, 0x78, 0x60, 0x00, 7, 0, 0, 0});
  expect_realtime("BackgroundSdo::step", [&] {
    background.step(host, now);
    bus.advance_to(now += 2ms);
  });
  expect_realtime("BackgroundSdo::take", [&] {
    background.step(host, now);
    background.take(current, now);
    bus.advance_to(now += 2ms);
  });
  EXPECT_EQ(background.number(0, 0), 7);
  expect_realtime("BackgroundSdo::prepare_again", [&] { background.prepare_again(0); });
  EXPECT_NE(background.preparation(0), BackgroundSdo::Preparation::kRefused);
  expect_realtime("BackgroundSdo::end_heartbeat", [&] {
    background.end_heartbeat(host, now);
    bus.advance_to(now += 2ms);
  });
}

}  // namespace
}  // namespace armature::cia402
