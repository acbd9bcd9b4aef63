// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/protocol/puck_protocol.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/testing/realtime_guard.hpp"
#include "robots/wam/protocol/pendant_word.hpp"

namespace armature::wam {
namespace {

using ::testing::Optional;

std::string text(const can::Frame& frame) { return std::string(can::to_text(frame).view()); }
can::Frame frame(const std::string& text) { return can::parse_frame(text).value(); }

constexpr int kTorqueNumber = 42;

// ---- Identifiers

TEST(PuckProtocol, IdentifiersNameSenderAndDestination) {
  EXPECT_EQ(identifier(to_node(1)), 0x001u);
  EXPECT_EQ(identifier(to_group(Group::kArm)), 0x404u);
  EXPECT_EQ(identifier(from_node(7, Group::kReplies)), 0x4e6u);
  EXPECT_EQ(identifier(from_node(2, Group::kPositions)), 0x443u);
  EXPECT_EQ(identifier({kBoardNode, 0, true}), 0x540u);
}

TEST(PuckProtocol, EveryIdentifierLeadsBackToItsAddress) {
  for (int from = 0; from <= kLastNode; ++from) {
    for (int to = 0; to <= kLastNode; ++to) {
      for (const bool group : {false, true}) {
        const Address address{from, to, group};
        const can::Frame made = can::data_frame(identifier(address), {});
        EXPECT_THAT(address_of(made), Optional(address));
      }
    }
  }
}

TEST(PuckProtocol, RemoteAndExtendedFramesHaveNoAddress) {
  EXPECT_EQ(address_of(can::remote_frame(0x404, 1)), std::nullopt);
  EXPECT_EQ(address_of(can::extended_frame(0x404, {0x30})), std::nullopt);
}

// ---- Values

TEST(PuckProtocol, ASetHasFourOrTwoBytesOfValue) {
  EXPECT_EQ(text(set_frame(to_node(2), 48, -36833)), "002#B0001F70FFFF");
  EXPECT_EQ(text(set_frame(to_node(10), 47, 4731, Width::kTwo)), "00A#AF007B12");
  EXPECT_EQ(text(get_frame(to_group(Group::kArm), 48)), "404#30");
  EXPECT_EQ(text(reply_frame(1, 0, 175, Width::kTwo)), "426#8000AF00");
}

TEST(PuckProtocol, ValuesKeepTheirSign) {
  EXPECT_THAT(parse_reply(frame("426#8500FFFF"), 5), Optional(-1));
  EXPECT_THAT(parse_reply(frame("426#85000080"), 5), Optional(-32768));
  EXPECT_THAT(parse_reply(frame("426#8500FF7F"), 5), Optional(32767));
  EXPECT_THAT(parse_reply(frame("426#8500FFFFFFFF"), 5), Optional(-1));
  EXPECT_THAT(parse_reply(frame("426#850000000080"), 5),
              Optional(std::numeric_limits<std::int32_t>::min()));
  EXPECT_THAT(parse_reply(frame("426#8500FFFF0000"), 5), Optional(65535));
}

TEST(PuckProtocol, AnAnswerThatIsNotJustThatIsRefused) {
  EXPECT_EQ(parse_reply(frame("426#850002"), 5), std::nullopt) << "three bytes";
  EXPECT_EQ(parse_reply(frame("426#8500020000"), 5), std::nullopt) << "five bytes";
  EXPECT_EQ(parse_reply(frame("426#85000200000000"), 5), std::nullopt) << "seven bytes";
  EXPECT_EQ(parse_reply(frame("426#"), 5), std::nullopt) << "no byte";
  EXPECT_EQ(parse_reply(frame("426#05000200"), 5), std::nullopt) << "no SET";
  EXPECT_EQ(parse_reply(frame("426#05"), 5), std::nullopt) << "a GET";
  EXPECT_EQ(parse_reply(frame("426#86000200"), 5), std::nullopt) << "another property";
  EXPECT_EQ(parse_reply(frame("426#85010200"), 5), std::nullopt) << "second byte not 0";
  EXPECT_THAT(parse_reply(frame("426#85000200"), 5), Optional(2));
}

TEST(PuckProtocol, AGetHasOneByteAndNothingElseHas) {
  EXPECT_THAT(parse_message(frame("001#05")), Optional(Message{false, 5, 0}));
  EXPECT_EQ(parse_message(frame("001#0500")), std::nullopt);
  EXPECT_EQ(parse_message(frame("001#85")), std::nullopt);
  EXPECT_THAT(parse_message(frame("404#880002000000")), Optional(Message{true, 8, 2}));
}

// ---- Positions

struct Position {
  std::int32_t counts;
  const char* set;
  const char* clear;
};
constexpr Position kGoldenPositions[] = {
    {0, "800000", "000000"},       {1, "800001", "000001"},      {-1, "BFFFFF", "3FFFFF"},
    {-2, "BFFFFE", "3FFFFE"},      {4096, "801000", "001000"},   {-36833, "BF701F", "3F701F"},
    {36832, "808FE0", "008FE0"},   {-36728, "BF7088", "3F7088"}, {2097151, "9FFFFF", "1FFFFF"},
    {-2097152, "A00000", "200000"}};

TEST(PuckProtocol, PositionsHave22BitsAndEitherFlag) {
  for (const auto& [counts, set, clear] : kGoldenPositions) {
    const Positions positions{counts, std::nullopt};
    EXPECT_EQ(text(position_frame(1, positions)), std::string("423#") + set);
    EXPECT_EQ(text(position_frame(1, positions, PositionFlags::kNone)),
              std::string("423#") + clear);
    EXPECT_THAT(parse_positions(frame(std::string("423#") + set)), Optional(positions));
    EXPECT_THAT(parse_positions(frame(std::string("423#") + clear)), Optional(positions));
  }
}

TEST(PuckProtocol, AJointEncoderFollowsInThreeMoreBytes) {
  EXPECT_EQ(text(position_frame(1, {0, -5})), "423#800000BFFFFB");
  EXPECT_THAT(parse_positions(frame("423#00002A3FFFFB")), Optional(Positions{42, -5}));
  EXPECT_EQ(text(joint_position_frame(1, -5)), "427#BFFFFB");
}

TEST(PuckProtocol, APositionHasThreeBytesOrSix) {
  for (const char* wrong : {"423#", "423#80", "423#8000", "423#80000000", "423#8000000000",
                            "423#80000000000000", "423#8000000000000000"}) {
    EXPECT_EQ(parse_positions(frame(wrong)), std::nullopt) << wrong;
  }
}

// ---- Torques

struct TorqueBytes {
  Torques torques;
  const char* data;
};
const TorqueBytes kGoldenTorques[] = {
    {{0, 0, 0, 0}, "AA00000000000000"},           {{1, 0, 0, 0}, "AA00040000000000"},
    {{0, 1, 0, 0}, "AA00000010000000"},           {{0, 0, 1, 0}, "AA00000000004000"},
    {{0, 0, 0, 1}, "AA00000000000001"},           {{-1, -1, -1, -1}, "AAFFFFFFFFFFFFFF"},
    {{100, -200, 300, -400}, "AA0193F3804B3E70"}, {{8191, -8191, 8191, -8191}, "AA7FFE0017FFE001"},
    {{1, 2, 3, 0}, "AA0004002000C000"},           {{-1, 2, -3, 0}, "AAFFFC002FFF4000"}};

TEST(PuckProtocol, FourTorquesShareAFrame) {
  for (const auto& [torques, data] : kGoldenTorques) {
    const std::string golden = std::string("401#") + data;
    EXPECT_EQ(text(torque_frame(Group::kLowerArm, kTorqueNumber, torques)), golden);
    EXPECT_THAT(parse_torques(frame(golden), kTorqueNumber), Optional(torques));
  }
}

TEST(PuckProtocol, AnyTorquesComeBackAsTheyWere) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> any(-8192, 8191);
  for (int i = 0; i < 5000; ++i) {
    Torques torques;
    for (auto& torque : torques) torque = static_cast<std::int16_t>(any(random));
    const can::Frame made = torque_frame(Group::kWrist, kTorqueNumber, torques);
    EXPECT_EQ(made.id, 0x402u);
    EXPECT_THAT(parse_torques(made, kTorqueNumber), Optional(torques));
  }
}

TEST(PuckProtocol, OlderFirmwareHasAnotherFirstByte) {
  EXPECT_EQ(text(torque_frame(Group::kLowerArm, 9, {1, 0, 0, 0})), "401#8900040000000000");
  EXPECT_EQ(parse_torques(frame("401#8900040000000000"), kTorqueNumber), std::nullopt);
}

TEST(PuckProtocol, ASetToTheSameGroupIsNoTorque) {
  EXPECT_EQ(parse_torques(frame("401#880000000000"), kTorqueNumber), std::nullopt);
  EXPECT_EQ(parse_torques(frame("401#AA000000000000"), kTorqueNumber), std::nullopt);
}

TEST(PuckProtocol, TorquesAreRoundedDownAndLimited) {
  EXPECT_EQ(torque_value(-64.3), -65);
  EXPECT_EQ(torque_value(64.9), 64);
  EXPECT_EQ(torque_value(1e9), kMostTorque);
  EXPECT_EQ(torque_value(-std::numeric_limits<double>::infinity()), -kMostTorque);
  EXPECT_EQ(torque_value(std::nan("")), 0);
}

// ---- The pendant

TEST(PendantWord, EveryWordComesBackAsItWas) {
  for (const char shown : {'0', '1', '2', '3', '4', '5', '6', '7', 'A', 'E', 'H', 'L'}) {
    for (const PendantKey key :
         {PendantKey::kEstop, PendantKey::kActivate, PendantKey::kIdle, PendantKey::kNone}) {
      const PendantWord word{
          key,
          true,
          false,
          shown,
          {Level::kFault, Level::kWarning, Level::kSafe, Level::kFault, Level::kWarning}};
      EXPECT_THAT(parse_pendant(pendant_value(word)), Optional(word));
    }
  }
}

TEST(PendantWord, AHeartbeatFaultIsBits9To11) {
  PendantWord word{.idle_lamp = true};
  word.levels[static_cast<std::size_t>(Monitor::kHeartbeat)] = Level::kFault;
  EXPECT_EQ(pendant_value(word), 0x0D3F1849);
}

TEST(PendantWord, ALevelThatIsNoneOfTheThreeIsRefused) {
  for (const std::int32_t bits : {0, 3, 5, 6, 7}) {
    EXPECT_EQ(parse_pendant((0x0D3F1249 & ~7) | bits), std::nullopt) << bits;
  }
}

TEST(PendantWord, AnUnknownPatternIsAQuestionMark) {
  EXPECT_EQ(parse_pendant(0x0D001249).value().display, '?');
}

// ---- Real time

TEST(PuckProtocol, NothingAllocates) {
  testing::RealtimeGuard guard;
  const auto all = [] {
    const can::Frame torques = torque_frame(Group::kLowerArm, kTorqueNumber, {1, 2, 3, 4});
    static_cast<void>(parse_torques(torques, kTorqueNumber));
    static_cast<void>(parse_positions(position_frame(1, {1, 2})));
    static_cast<void>(parse_reply(reply_frame(1, 5, 2, Width::kTwo), 5));
    static_cast<void>(parse_message(set_frame(to_node(1), 5, 2)));
    static_cast<void>(address_of(torques));
    static_cast<void>(parse_pendant(pendant_value({})));
  };
  EXPECT_EQ(guard.watch(all), 0u) << guard.report();
}

}  // namespace
}  // namespace armature::wam
