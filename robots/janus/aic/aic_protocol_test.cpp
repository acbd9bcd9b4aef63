// SPDX-License-Identifier: Apache-2.0
#include "robots/janus/aic/aic_protocol.hpp"

#include <cmath>
#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::janus {
namespace {

using can::data_frame;

std::string text(const can::Frame& frame) { return std::string(can::to_text(frame).view()); }
can::Frame frame(const char* text) { return can::parse_frame(text).value(); }

TEST(AicProtocol, FramesOfTheHostAreTheseBytes) {
  EXPECT_EQ(text(sync_frame(0x2a)), "080#2A");
  EXPECT_EQ(text(command_frame(1, AicCommand::kActuatorOn)), "101#01");
  EXPECT_EQ(text(command_frame(2, AicCommand::kActuatorOff)), "102#02");
  EXPECT_EQ(text(command_frame(2, AicCommand::kBrakeApply)), "102#03");
  EXPECT_EQ(text(command_frame(2, AicCommand::kBrakeRelease)), "102#04");
  EXPECT_EQ(text(watchdog_frame(1, 0x1234)), "101#053412");
  EXPECT_EQ(text(command_frame(127, AicCommand::kIdentify)), "17F#06");
  EXPECT_EQ(text(motor_frame(1, 0x0102)), "201#0201");
  EXPECT_EQ(text(motor_frame(2, -2)), "202#FEFF");
  EXPECT_EQ(text(motor_group_frame(0, {1, -1, 32767, -32767})), "280#0100FFFFFF7F0180");
  EXPECT_EQ(text(motor_group_frame(31, {})), "29F#0000000000000000");
  EXPECT_EQ(text(request_frame(2)), "302#");
}

TEST(AicProtocol, FramesOfTheCardAreTheseBytes) {
  EXPECT_EQ(text(emergency_frame(2, {AicEmergency::kWatchdog, AicState::kWatchdog})), "002#0203");
  EXPECT_EQ(text(heartbeat_frame(1, {AicState::kOn, 0x0100, 0x0203})), "381#0200010302");
  SensorReport report;
  EXPECT_EQ(text(sensor_frame(1, report)), "181#0000000000000000");
  report = {.counts = -2,
            .index = true,
            .actuator_on = true,
            .brake_released = true,
            .fault = true,
            .watchdog_tripped = true,
            .counter = 7,
            .current_ma = -300};
  EXPECT_EQ(text(sensor_frame(2, report)), "182#FEFFFFFF1F07D4FE");
}

TEST(AicProtocol, EachFlagIsABitOfItsOwn) {
  const auto with_flags = [](std::uint8_t flags) {
    return parse_sensor(data_frame(0x181, {0, 0, 0, 0, flags, 0, 0, 0})).value();
  };
  EXPECT_EQ(with_flags(0x01), (SensorReport{.index = true}));
  EXPECT_EQ(with_flags(0x02), (SensorReport{.actuator_on = true}));
  EXPECT_EQ(with_flags(0x04), (SensorReport{.brake_released = true}));
  EXPECT_EQ(with_flags(0x08), (SensorReport{.fault = true}));
  EXPECT_EQ(with_flags(0x10), (SensorReport{.watchdog_tripped = true}));
  EXPECT_EQ(with_flags(0xe0), SensorReport{}) << "the others mean nothing yet";
}

TEST(AicProtocol, WhatIsReadIsWhatWasWritten) {
  EXPECT_EQ(parse_emergency(frame("002#0203")),
            (Emergency{AicEmergency::kWatchdog, AicState::kWatchdog}));
  EXPECT_EQ(parse_heartbeat(frame("381#0200010302")), (Heartbeat{AicState::kOn, 0x0100, 0x0203}));
  EXPECT_EQ(parse_sensor(frame("182#00000080FF80FF7F")).value().counts,
            std::numeric_limits<std::int32_t>::min());
  EXPECT_EQ(parse_sensor(frame("182#00000080FF80FF7F")).value().counter, 0x80);
  EXPECT_EQ(parse_sensor(frame("182#00000080FF80FF7F")).value().current_ma, 32767);
  EXPECT_EQ(parse_motor(frame("201#FEFF")), -2);
  EXPECT_EQ(parse_motor_group(frame("280#0100FFFFFF7F0180")), (GroupValues{1, -1, 32767, -32767}));
  EXPECT_EQ(parse_watchdog(frame("101#053412")), 0x1234);
  for (std::uint8_t opcode = 1; opcode <= 6; ++opcode) {
    if (opcode == 5) continue;
    EXPECT_EQ(parse_command(data_frame(0x101, {opcode})), static_cast<AicCommand>(opcode));
  }
}

TEST(AicProtocol, AnotherLengthIsNoMessage) {
  for (std::uint8_t size = 0; size <= 8; ++size) {
    can::Frame any = data_frame(0x101, {1, 1, 1, 0, 0, 0, 0, 0});
    any.size = size;
    EXPECT_EQ(parse_emergency(any).has_value(), size == 2);
    EXPECT_EQ(parse_sensor(any).has_value(), size == 8);
    EXPECT_EQ(parse_heartbeat(any).has_value(), size == 5);
    EXPECT_EQ(parse_command(any).has_value(), size == 1);
    EXPECT_EQ(parse_motor(any).has_value(), size == 2);
    EXPECT_EQ(parse_motor_group(any).has_value(), size == 8);
    any.data[0] = 5;
    EXPECT_EQ(parse_watchdog(any).has_value(), size == 3);
  }
}

TEST(AicProtocol, AnUnknownCodeIsNoMessage) {
  EXPECT_FALSE(parse_command(data_frame(0x101, {0})));
  EXPECT_FALSE(parse_command(data_frame(0x101, {7})));
  EXPECT_FALSE(parse_watchdog(data_frame(0x101, {5, 0, 0}))) << "a watchdog cannot be switched off";
  EXPECT_FALSE(parse_emergency(data_frame(0x001, {0, 4})));
  EXPECT_FALSE(parse_emergency(data_frame(0x001, {5, 4})));
  EXPECT_FALSE(parse_emergency(data_frame(0x001, {1, 5})));
  EXPECT_FALSE(parse_heartbeat(data_frame(0x381, {5, 0, 0, 0, 0})));
}

TEST(AicProtocol, AnIdentifierTellsTheFunctionAndTheCard) {
  for (const auto function :
       {AicFunction::kEmergency, AicFunction::kCommand, AicFunction::kSensor, AicFunction::kMotor,
        AicFunction::kRequest, AicFunction::kHeartbeat}) {
    for (int card = 1; card <= kMostCards; ++card) {
      const auto address = address_of(data_frame(identifier(function, card), {}));
      ASSERT_TRUE(address);
      EXPECT_EQ(address->function, function);
      EXPECT_EQ(address->number, card);
    }
    EXPECT_FALSE(address_of(data_frame(identifier(function, 0), {})));
  }
  EXPECT_EQ(address_of(sync_frame(0))->function, AicFunction::kSync);
  EXPECT_FALSE(address_of(data_frame(0x081, {})));
  EXPECT_EQ(address_of(data_frame(0x29f, {}))->number, 31);
  EXPECT_FALSE(address_of(data_frame(0x2a0, {}))) << "no card is in such a group";
  EXPECT_FALSE(address_of(data_frame(0x400, {})));
  EXPECT_FALSE(address_of(data_frame(0x7ff, {})));
  EXPECT_FALSE(address_of(can::remote_frame(0x301, 0)));
  EXPECT_FALSE(address_of(can::extended_frame(0x301, {})));
}

TEST(AicProtocol, MotorValuesAreSharesOfTheSupply) {
  EXPECT_EQ(motor_value(0.0), 0);
  EXPECT_EQ(motor_value(1.0), 32767);
  EXPECT_EQ(motor_value(-1.0), -32767);
  EXPECT_EQ(motor_value(0.5), 16384);
  EXPECT_EQ(motor_value(7.0), 32767);
  EXPECT_EQ(motor_value(-std::numeric_limits<double>::infinity()), -32767);
  EXPECT_EQ(motor_value(std::nan("")), 0);
  EXPECT_DOUBLE_EQ(motor_share(32767), 1.0);
  EXPECT_DOUBLE_EQ(motor_share(-32768), -1.0);
  EXPECT_DOUBLE_EQ(motor_share(1), 1.0 / 32767.0);
}

TEST(AicProtocol, FourCardsAreAGroup) {
  EXPECT_EQ(group_of(1), 0);
  EXPECT_EQ(place_in_group(1), 0);
  EXPECT_EQ(group_of(4), 0);
  EXPECT_EQ(place_in_group(4), 3);
  EXPECT_EQ(group_of(5), 1);
  EXPECT_EQ(group_of(127), 31);
}

TEST(AicProtocol, TheCounterTellsHowManyReportsLie) {
  std::uint8_t counter = 0;
  for (int i = 1; i <= 255; ++i) {
    counter = next_counter(counter);
    ASSERT_NE(counter, 0) << "0 is the first after power-up only";
    EXPECT_EQ(reports_since(0, counter), i);
  }
  EXPECT_EQ(counter, 255);
  EXPECT_EQ(next_counter(255), 1);
  EXPECT_EQ(reports_since(255, 1), 1);
  EXPECT_EQ(reports_since(254, 3), 4);
  EXPECT_EQ(reports_since(9, 9), 0);
  EXPECT_EQ(reports_since(9, 8), 254);
}

}  // namespace
}  // namespace armature::janus
