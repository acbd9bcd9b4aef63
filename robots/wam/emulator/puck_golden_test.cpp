// SPDX-License-Identifier: Apache-2.0
#include <map>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "robots/wam/protocol/pendant_word.hpp"
#include "robots/wam/protocol/puck_properties.hpp"
#include "robots/wam/protocol/puck_protocol.hpp"
#include "robots/wam/protocol/test_golden.hpp"

namespace armature::wam {
namespace {

using ::testing::Optional;

constexpr int kPuckVersion = 175;
constexpr int kBoardVersion = 200;

int puck(Property property) { return number_of(PuckKind::kMotor, kPuckVersion, property).value(); }
int board(Property property) {
  return number_of(PuckKind::kSafety, kBoardVersion, property).value();
}

can::Frame get(int node, Property property) { return get_frame(to_node(node), puck(property)); }
can::Frame set(int node, Property property, std::int32_t value) {
  return set_frame(to_node(node), puck(property), value);
}
can::Frame reply(int node, Property property, std::int32_t value, Width width = Width::kTwo) {
  return reply_frame(node, puck(property), value, width);
}
can::Frame position(int node, std::int32_t counts) {
  return position_frame(node, {counts, std::nullopt});
}
can::Frame torques(Group group, const Torques& values) {
  return torque_frame(group, puck(Property::kT), values);
}
can::Frame tell_board(Property property, std::int32_t value, Width width = Width::kFour) {
  return set_frame(to_node(kBoardNode), board(property), value, width);
}
can::Frame board_says(Property property, std::int32_t value, Width width = Width::kTwo) {
  return reply_frame(kBoardNode, board(property), value, width);
}
can::Frame board_tells_all(PuckMode mode) {
  return set_frame({kBoardNode, 0, true}, puck(Property::kMode), static_cast<int>(mode));
}
can::Frame pendant(const PendantWord& word) {
  return board_says(Property::kPen, pendant_value(word), Width::kFour);
}
PendantWord with(Monitor monitor, Level level) {
  PendantWord word{.idle_lamp = true};
  word.levels[static_cast<std::size_t>(monitor)] = level;
  return word;
}

constexpr int kReset = static_cast<int>(PuckStatus::kReset);
constexpr int kReady = static_cast<int>(PuckStatus::kReady);

/// What the file's names mean, made by the protocol.
std::map<std::string, can::Frame> made_frames() {
  const Property kTl1 = Property::kTl1, kTl2 = Property::kTl2;
  const Property kVl1 = Property::kVl1, kVl2 = Property::kVl2;
  return {
      {"GET STAT node 1", get(1, Property::kStat)},
      {"GET STAT node 2", get(2, Property::kStat)},
      {"GET STAT node 10", get_frame(to_node(10), board(Property::kStat))},
      {"GET STAT node 31", get(31, Property::kStat)},
      {"GET VERS node 1", get(1, Property::kVers)},
      {"reply STAT=0 node 1 (DLC4)", reply(1, Property::kStat, kReset)},
      {"reply STAT=0 node 7 (DLC4)", reply(7, Property::kStat, kReset)},
      {"reply STAT=2 node 7 (DLC4)", reply(7, Property::kStat, kReady)},
      {"reply STAT=2 node 1 (DLC6 form, also legal)",
       reply(1, Property::kStat, kReady, Width::kFour)},
      {"reply ROLE=0x0100 node 1", reply(1, Property::kRole, kAbsoluteEncoder)},
      {"reply VERS=175 node 1", reply(1, Property::kVers, 175)},
      {"wake node 1 (SET STAT=2)", set(1, Property::kStat, kReady)},
      {"wake node 3 (SET STAT=2)", set(3, Property::kStat, kReady)},
      {"wake node 4 (SET STAT=2)", set(4, Property::kStat, kReady)},
      {"wake node 6 (SET STAT=2)", set(6, Property::kStat, kReady)},
      {"wake node 7 (SET STAT=2)", set(7, Property::kStat, kReady)},
      {"all motor nodes MODE=2 (group 0, DLC4, manual example)",
       set_frame(to_group(Group::kAll), puck(Property::kMode), 2, Width::kTwo)},
      {"sleep node 1 to monitor (SET STAT=0)", set(1, Property::kStat, kReset)},
      {"reply CTS=4096 node 1 (DLC6)", reply(1, Property::kCts, 4096, Width::kFour)},
      {"GET IPNM node 1 (fw>=65)", get(1, Property::kIpnm)},
      {"reply IPNM=17474 node 7", reply(7, Property::kIpnm, 17474)},
      {"GET POLES node 7", get(7, Property::kPoles)},
      {"GET MECH node 1 (fw>=65)", get(1, Property::kMech)},
      {"GET PIDX node 5", get(5, Property::kPidx)},
      {"group 4 SET MODE=0", set_frame(to_group(Group::kArm), puck(Property::kMode), 0)},
      {"group 4 GET P (fw>=61)", get_frame(to_group(Group::kArm), puck(Property::kP))},
      {"reply P=0 node 1, flag bit set", position(1, 0)},
      {"reply P=1 node 1, flag bit set", position(1, 1)},
      {"reply P=-36833 node 2, flag bit set", position(2, -36833)},
      {"reply P=36832 node 3, flag bit set", position(3, 36832)},
      {"reply P=2 node 5, flag bit set", position(5, 2)},
      {"reply P=7 node 6, flag bit set", position(6, 7)},
      {"reply P=2097151 node 1, flag bit set", position(1, kMostCounts)},
      {"reply P=-2097152 node 1, flag bit set", position(1, kLeastCounts)},
      {"reply P=0 JP=-5 node 1 (joint encoder puck)", position_frame(1, {0, -5})},
      {"reply JP=-5 node 1 on its own", joint_position_frame(1, -5)},
      {"SET P=-36833 node 2 (zeroing, fw>=61)", set(2, Property::kP, -36833)},
      {"SET P=36832 node 3 (zeroing, fw>=61)", set(3, Property::kP, 36832)},
      {"SET P=0 node 5 (zeroing, fw>=61)", set(5, Property::kP, 0)},
      {"packed torque group 1 [0, 0, 0, 0]", torques(Group::kLowerArm, {0, 0, 0, 0})},
      {"packed torque group 1 [0, 1, 0, 0]", torques(Group::kLowerArm, {0, 1, 0, 0})},
      {"packed torque group 1 [0, 0, 1, 0]", torques(Group::kLowerArm, {0, 0, 1, 0})},
      {"packed torque group 1 [-1, -1, -1, -1]", torques(Group::kLowerArm, {-1, -1, -1, -1})},
      {"packed torque group 1 [100, -200, 300, -400]",
       torques(Group::kLowerArm, {100, -200, 300, -400})},
      {"packed torque group 1 [-65, -33, -129, -150]",
       torques(Group::kLowerArm, {-65, -33, -129, -150})},
      {"packed torque group 2 [0, 670, -1171]", torques(Group::kWrist, {0, 670, -1171, 0})},
      {"packed torque group 2 [-1, 2, -3]", torques(Group::kWrist, {-1, 2, -3, 0})},
      {"safety SET TL1=4731 (DLC4, wiki example)", tell_board(kTl1, 4731, Width::kTwo)},
      {"safety SET TL2=5204 (DLC4, wiki example)", tell_board(kTl2, 5204, Width::kTwo)},
      {"safety SET TL2=5204 (DLC6, libbarrett form)", tell_board(kTl2, 5204)},
      {"safety SET VL1=2048 (DLC6, libbarrett form)", tell_board(kVl1, 2048)},
      {"safety SET VL2=4096 (DLC4, wiki example)", tell_board(kVl2, 4096, Width::kTwo)},
      {"safety DEF VL1", tell_board(Property::kDef, board(kVl1))},
      {"safety LOAD VL1", tell_board(Property::kLoad, board(kVl1))},
      {"safety LOAD VL2", tell_board(Property::kLoad, board(kVl2))},
      {"safety DEF TL1", tell_board(Property::kDef, board(kTl1))},
      {"safety DEF TL2", tell_board(Property::kDef, board(kTl2))},
      {"safety LOAD TL2", tell_board(Property::kLoad, board(kTl2))},
      {"safety reply MODE=0", board_says(Property::kMode, 0)},
      {"safety reply MODE=1", board_says(Property::kMode, 1)},
      {"safety GET ZERO", get_frame(to_node(kBoardNode), board(Property::kZero))},
      {"safety reply ZERO=0", board_says(Property::kZero, 0)},
      {"safety SET ZERO=1", tell_board(Property::kZero, 1)},
      {"safety SET IFAULT=5", tell_board(Property::kIfault, 5)},
      {"safety reply PEN: E-stop pressed, char E, all safe (0x00791249)",
       pendant({.key = PendantKey::kEstop, .display = 'E'})},
      {"safety reply PEN: no button, idle light, char 0, all safe (0x0D3F1249)",
       pendant({.idle_lamp = true})},
      {"safety reply PEN: no button, idle light, velocity FAULT (0x0D3F124C)",
       pendant(with(Monitor::kVelocity, Level::kFault))},
      {"safety reply PEN: no button, idle light, torque WARNING (0x0D3F1251)",
       pendant(with(Monitor::kTorque, Level::kWarning))},
      {"safety broadcast MODE=2 on activate", board_tells_all(PuckMode::kTorque)},
      {"safety broadcast MODE=0 on idle or fault", board_tells_all(PuckMode::kIdle)},
      {"emergency MODE=0 upper arm", set_frame(to_group(Group::kWrist), puck(Property::kMode), 0)},
      {"F/T GET FT",
       get_frame(to_node(8), number_of(PuckKind::kForceTorque, 1, Property::kFt).value())},
  };
}

TEST(PuckGolden, EveryFrameIsMadeToTheBit) {
  auto made = made_frames();
  for (const GoldenFrame& golden : golden_frames()) {
    ASSERT_TRUE(made.contains(golden.name)) << golden.name;
    EXPECT_EQ(made[golden.name], golden.frame)
        << golden.name << ": " << can::to_text(made[golden.name]).view();
    made.erase(golden.name);
  }
  EXPECT_EQ(made.size(), 0u) << "made, but not in the file: " << made.begin()->first;
}

TEST(PuckGolden, EveryIdentifierSaysWhoSendsToWhom) {
  for (const GoldenFrame& golden : golden_frames()) {
    EXPECT_THAT(address_of(golden.frame), Optional(golden.address)) << golden.name;
    EXPECT_EQ(identifier(golden.address), golden.frame.id) << golden.name;
  }
}

/// A frame read and written again is the same, so reading loses nothing.
can::Frame written_again(const GoldenFrame& golden) {
  const can::Frame& frame = golden.frame;
  const Address& address = golden.address;
  const bool to_positions = address.group && address.to == static_cast<int>(Group::kPositions);
  const bool to_joints = address.group && address.to == static_cast<int>(Group::kJointPositions);
  if (to_positions) return position_frame(address.from, parse_positions(frame).value());
  if (to_joints) {
    return joint_position_frame(address.from, parse_positions(frame).value().motor);
  }
  if (frame.size == 8) {
    const int number = puck(Property::kT);
    return torque_frame(static_cast<Group>(address.to), number,
                        parse_torques(frame, number).value());
  }
  const Message message = parse_message(frame).value();
  if (!message.set) return get_frame(address, message.number);
  return set_frame(address, message.number, message.value,
                   frame.size == 4 ? Width::kTwo : Width::kFour);
}

TEST(PuckGolden, EveryFrameIsUnderstood) {
  for (const GoldenFrame& golden : golden_frames()) {
    EXPECT_EQ(written_again(golden), golden.frame) << golden.name;
  }
}

}  // namespace
}  // namespace armature::wam
