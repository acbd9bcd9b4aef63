// SPDX-License-Identifier: Apache-2.0
// Every state with every control word and every status word.
#include "drives/cia402/power.hpp"

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drives/cia402/homing.hpp"
#include "drives/cia402/mode.hpp"
#include "drives/cia402/scaling.hpp"

namespace armature::cia402 {
namespace {

using enum PowerState;

constexpr std::array kStates = {
    kNotReadyToSwitchOn, kSwitchOnDisabled, kReadyToSwitchOn,     kSwitchedOn,
    kOperationEnabled,   kQuickStopActive,  kFaultReactionActive, kFault};
constexpr std::array kGoals = {PowerGoal::kOff, PowerGoal::kReady, PowerGoal::kSwitchedOn,
                               PowerGoal::kEnabled, PowerGoal::kQuickStop};
constexpr unsigned kWords = 0x10000;

/// A machine that was brought to `state` by legal steps.
PowerMachine machine_in(PowerState state) {
  PowerMachine machine;
  if (state == kNotReadyToSwitchOn) return machine;
  machine.start();
  machine.take_control(0x00);
  if (state >= kReadyToSwitchOn) machine.take_control(0x06);
  if (state >= kSwitchedOn) machine.take_control(0x07);
  if (state >= kOperationEnabled) machine.take_control(0x0f);
  if (state == kQuickStopActive) machine.take_control(0x02);
  if (state >= kFaultReactionActive) machine.fail();
  if (state == kFault) machine.standing();
  return machine;
}

TEST(StatusWords, EachOfAllIsOfAtMostOneState) {
  std::array<int, kStates.size()> counts{};
  int none = 0;
  for (unsigned word = 0; word < kWords; ++word) {
    const auto state = decode_status(static_cast<std::uint16_t>(word));
    if (state) {
      ++counts[static_cast<std::size_t>(*state)];
    } else {
      ++none;
    }
  }
  // In four states five bits of 16 count, in the others six.
  EXPECT_THAT(counts, ::testing::ElementsAre(2048, 2048, 1024, 1024, 1024, 1024, 2048, 2048));
  EXPECT_EQ(none, 65536 - 12288);
}

TEST(StatusWords, EachThatHasTheBitsOfAStateIsOfThatState) {
  for (const PowerState state : kStates) {
    const bool quick_stop_counts = state == kReadyToSwitchOn || state == kSwitchedOn ||
                                   state == kOperationEnabled || state == kQuickStopActive;
    const unsigned mask = quick_stop_counts ? 0x6f : 0x4f;
    for (unsigned word = 0; word < kWords; ++word) {
      const bool has_bits = (word & mask) == (encode_state(state) & mask);
      ASSERT_EQ(decode_status(static_cast<std::uint16_t>(word)) == state, has_bits)
          << to_text(state) << ", " << word;
    }
  }
}

TEST(StatusWords, AStateIsReadAsItIsWritten) {
  for (const PowerState state : kStates) {
    EXPECT_EQ(decode_status(encode_state(state)), state) << to_text(state);
    EXPECT_EQ(decode_status(encode_state(state) | 0xff90), state) << to_text(state);
  }
}

TEST(ControlWords, ACommandIsReadAsItIsWritten) {
  for (const PowerCommand command :
       {PowerCommand::kDisableVoltage, PowerCommand::kQuickStop, PowerCommand::kShutdown,
        PowerCommand::kSwitchOn, PowerCommand::kEnableOperation}) {
    EXPECT_EQ(decode_control(encode_command(command)), command);
  }
}

TEST(PowerMachine, IsBroughtToEachState) {
  for (const PowerState state : kStates) EXPECT_EQ(machine_in(state).state(), state);
}

TEST(PowerMachine, NothingButARisingResetBitLeavesAFault) {
  for (unsigned first = 0; first < kWords; first += 0x80) {
    for (unsigned second = 0; second < kWords; ++second) {
      PowerMachine machine = machine_in(kFault);
      machine.take_control(static_cast<std::uint16_t>(first & 0x80));
      const PowerState between = machine.state();
      if (between != kFault) break;  // the first was a rising edge itself
      machine.take_control(static_cast<std::uint16_t>(second));
      const bool rises = (second & 0x80) != 0 && (first & 0x80) == 0;
      ASSERT_EQ(machine.state(), rises ? kSwitchOnDisabled : kFault) << first << ", " << second;
    }
    if (first >= 0x100) break;  // only bit 7 of the first counts
  }
}

TEST(PowerMachine, NoControlWordEndsAFaultReaction) {
  for (unsigned word = 0; word < kWords; ++word) {
    PowerMachine machine = machine_in(kFaultReactionActive);
    machine.take_control(static_cast<std::uint16_t>(word));
    ASSERT_EQ(machine.state(), kFaultReactionActive) << word;
  }
}

TEST(PowerMachine, OperationIsEnabledFromSwitchedOnAlone) {
  for (const PowerState state : kStates) {
    for (unsigned word = 0; word < kWords; ++word) {
      PowerMachine machine = machine_in(state);
      machine.take_control(static_cast<std::uint16_t>(word));
      if (machine.state() != kOperationEnabled) continue;
      ASSERT_TRUE(state == kSwitchedOn || state == kOperationEnabled) << to_text(state);
      ASSERT_EQ(decode_control(static_cast<std::uint16_t>(word)), PowerCommand::kEnableOperation);
    }
  }
}

TEST(PowerMachine, AResetBitThatStaysUpDoesNotResetTheNextFault) {
  PowerMachine machine = machine_in(kFault);
  machine.take_control(0x80);
  ASSERT_EQ(machine.state(), kSwitchOnDisabled);
  machine.fail();
  machine.standing();
  machine.take_control(0x80);
  EXPECT_EQ(machine.state(), kFault);
}

TEST(PowerMachine, AQuickStopEndsWhereItIsConfigured) {
  PowerMachine ends = machine_in(kQuickStopActive);
  ends.standing();
  EXPECT_EQ(ends.state(), kSwitchOnDisabled);
  PowerMachine stays(true);
  stays.start();
  for (const std::uint16_t word : std::array<std::uint16_t, 4>{0x06, 0x07, 0x0f, 0x02})
    stays.take_control(word);
  stays.standing();
  EXPECT_EQ(stays.state(), kQuickStopActive);
}

/// Every state, goal and history of a reset.
TEST(PowerControl, NoWordEnablesOperationUnlessThatIsTheGoal) {
  for (const PowerState state : kStates) {
    for (const PowerGoal goal : kGoals) {
      for (const bool reset : {false, true}) {
        PowerControl control;
        control.set_goal(goal);
        if (reset) control.ask_reset();
        for (int step = 0; step < 3; ++step) {
          const std::uint16_t word = control.step(state);
          const bool enables = decode_control(word) == PowerCommand::kEnableOperation;
          ASSERT_EQ(enables, goal == PowerGoal::kEnabled &&
                                 (state == kSwitchedOn || state == kOperationEnabled))
              << to_text(state) << " " << int(goal);
        }
      }
    }
  }
}

TEST(PowerControl, ResetsAFaultAtTheOperatorsWordAlone) {
  for (const PowerState state : kStates) {
    for (const PowerGoal goal : kGoals) {
      PowerControl control;
      control.set_goal(goal);
      for (int step = 0; step < 10; ++step) {
        ASSERT_EQ(control.step(state) & control_bit::kFaultReset, 0) << to_text(state);
      }
    }
  }
}

TEST(PowerControl, AWordGivenBeforeAFaultDoesNotResetIt) {
  PowerControl control;
  control.ask_reset();
  control.step(kOperationEnabled);
  for (int step = 0; step < 10; ++step) {
    EXPECT_EQ(control.step(kFault) & control_bit::kFaultReset, 0);
  }
}

TEST(PowerControl, ABitThatRisesOnceForEachWord) {
  PowerControl control;
  control.ask_reset();
  std::vector<int> bits;
  for (int step = 0; step < 5; ++step) bits.push_back(control.step(kFault) >> 7);
  EXPECT_THAT(bits, ::testing::ElementsAre(0, 1, 0, 0, 0));
}

TEST(PowerControl, AQuickStopThatTheDriveBeganIsBrakedToItsEnd) {
  for (const PowerGoal goal : kGoals) {
    PowerMachine machine = machine_in(kOperationEnabled);
    PowerControl control;
    control.set_goal(goal);
    machine.take_control(0x02);
    ASSERT_EQ(machine.state(), kQuickStopActive);
    for (int step = 0; step < 10; ++step) machine.take_control(control.step(machine.state()));
    EXPECT_EQ(machine.state(), goal == PowerGoal::kOff ? kSwitchOnDisabled : kQuickStopActive);
  }
}

TEST(PowerControl, AnUnknownStatusIsAnsweredWithNoVoltage) {
  for (const PowerGoal goal : kGoals) {
    PowerControl control;
    control.set_goal(goal);
    EXPECT_EQ(control.step(std::nullopt), 0);
  }
}

/// Host and drive together, from each state to each goal.
TEST(PowerControl, BringsADriveToItsGoalInAtMostThreeSteps) {
  const auto expected = [](PowerState state, PowerGoal goal) {
    switch (goal) {
      case PowerGoal::kOff:
        return kSwitchOnDisabled;
      case PowerGoal::kReady:
        return kReadyToSwitchOn;
      case PowerGoal::kSwitchedOn:
        return kSwitchedOn;
      case PowerGoal::kEnabled:
        return kOperationEnabled;
      case PowerGoal::kQuickStop:
        return state == kOperationEnabled ? kQuickStopActive : kSwitchOnDisabled;
    }
    return kFault;
  };
  for (const PowerState state :
       {kSwitchOnDisabled, kReadyToSwitchOn, kSwitchedOn, kOperationEnabled}) {
    for (const PowerGoal goal : kGoals) {
      PowerMachine machine = machine_in(state);
      PowerControl control;
      control.set_goal(goal);
      for (int step = 0; step < 3; ++step) machine.take_control(control.step(machine.state()));
      EXPECT_EQ(machine.state(), expected(state, goal)) << to_text(state) << " " << int(goal);
    }
  }
}

/// Two program the same drive, or it has a switch of its own.
TEST(PowerControl, ADriveThatWasSwitchedOffElsewhereDoesNotStartByItself) {
  for (const PowerGoal goal : {PowerGoal::kSwitchedOn, PowerGoal::kEnabled}) {
    for (const std::uint16_t word : std::array<std::uint16_t, 3>{0x00, 0x06, 0x07}) {
      PowerMachine machine = machine_in(kSwitchOnDisabled);
      PowerControl control;
      control.set_goal(goal);
      for (int step = 0; step < 4; ++step) machine.take_control(control.step(machine.state()));
      const PowerState reached = machine.state();
      machine.take_control(word);
      if (machine.state() == reached) continue;  // it has what it was given
      for (int step = 0; step < 10; ++step) {
        machine.take_control(control.step(machine.state()));
        ASSERT_NE(machine.state(), kOperationEnabled) << word;
      }
      EXPECT_EQ(machine.state(), kSwitchOnDisabled) << word;
      EXPECT_EQ(control.goal(), PowerGoal::kOff);
      control.set_goal(goal);
      for (int step = 0; step < 4; ++step) machine.take_control(control.step(machine.state()));
      EXPECT_EQ(machine.state(), reached) << "given anew";
    }
  }
}

TEST(PowerControl, ADriveThatIsOnItsWayToItsGoalHasNotFallen) {
  PowerMachine machine = machine_in(kSwitchedOn);
  PowerControl control;
  control.set_goal(PowerGoal::kSwitchedOn);
  machine.take_control(control.step(machine.state()));
  control.set_goal(PowerGoal::kEnabled);
  // Its answers are cycles old.
  for (int step = 0; step < 3; ++step) control.step(kSwitchedOn);
  machine.take_control(control.step(machine.state()));
  EXPECT_EQ(machine.state(), kOperationEnabled);
  EXPECT_EQ(control.goal(), PowerGoal::kEnabled);
}

TEST(PowerControl, AfterAFaultOrAQuickStopADriveDoesNotStartByItself) {
  for (const PowerState stop : {kFault, kQuickStopActive}) {
    PowerMachine machine = machine_in(kOperationEnabled);
    PowerControl control;
    control.set_goal(PowerGoal::kEnabled);
    if (stop == kFault) {
      machine.fail();
    } else {
      machine.take_control(0x02);  // somebody else's, or a switch of the drive
    }
    control.step(machine.state());
    machine.standing();
    control.ask_reset();
    for (int step = 0; step < 10; ++step) {
      machine.take_control(control.step(machine.state()));
      ASSERT_NE(machine.state(), kOperationEnabled);
      ASSERT_NE(machine.state(), kSwitchedOn);
    }
    EXPECT_EQ(machine.state(), kSwitchOnDisabled);
    EXPECT_EQ(control.goal(), stop == kFault ? PowerGoal::kOff : PowerGoal::kQuickStop);
    control.set_goal(PowerGoal::kEnabled);
    for (int step = 0; step < 3; ++step) machine.take_control(control.step(machine.state()));
    EXPECT_EQ(machine.state(), kOperationEnabled);
  }
}

TEST(Modes, HaveTheirBitsAndNames) {
  EXPECT_EQ(supported_bit(Mode::kProfilePosition), 0x001u);
  EXPECT_EQ(supported_bit(Mode::kHoming), 0x020u);
  EXPECT_EQ(supported_bit(Mode::kCyclicPosition), 0x080u);
  EXPECT_EQ(supported_bit(Mode::kCyclicTorque), 0x200u);
  EXPECT_EQ(supported_bit(Mode::kNone), 0u);
  EXPECT_EQ(supported_text(0x081), "PP, CSP");
  EXPECT_EQ(supported_text(0), "none");
  EXPECT_EQ(parse_mode("CSV"), Mode::kCyclicVelocity);
  EXPECT_FALSE(parse_mode("csv"));
}

TEST(HomingMethods, AreFoundByNumber) {
  EXPECT_EQ(homing_methods().size(), 32u);
  EXPECT_EQ(find_homing_method(37)->mark, HomingMark::kHere);
  EXPECT_TRUE(find_homing_method(1)->with_index);
  EXPECT_FALSE(find_homing_method(17)->with_index);
  for (const std::int8_t reserved : std::array<std::int8_t, 6>{0, 15, 16, 31, 32, -1}) {
    EXPECT_FALSE(find_homing_method(reserved)) << int{reserved};
  }
}

TEST(Scaling, IncrementsOfTheMotorBecomeRadiansOfTheShaft) {
  const Factors factors{.encoder_increments = 4096,
                        .motor_revolutions = 1,
                        .gear_motor = 100,
                        .gear_shaft = 1,
                        .rated_torque_mNm = 500,
                        .rated_current_mA = 2000};
  const Scaling scaling = Scaling::make(factors, PositionUnit::kIncrements).value();
  EXPECT_NEAR(scaling.position(409'600), 6.283185307179586, 1e-12);
  EXPECT_NEAR(scaling.velocity(-204'800), -3.141592653589793, 1e-12);
  EXPECT_NEAR(scaling.torque(1000), 50.0, 1e-12);
  EXPECT_NEAR(scaling.current(-500), -1.0, 1e-12);
  EXPECT_EQ(scaling.raw_torque(25.0), 500);
  for (const std::int32_t raw : {0, 1, -1, 409'600, 2147483647, -2147483647}) {
    EXPECT_EQ(scaling.raw_position(scaling.position(raw)), raw);
  }
}

TEST(Scaling, TheFeedConstantCountsWhereItIsTheUnit) {
  const Factors factors{.encoder_increments = 4096, .gear_motor = 50, .feed = 360'000};
  const Scaling scaling = Scaling::make(factors, PositionUnit::kFeed).value();
  EXPECT_NEAR(scaling.position(180'000), 3.141592653589793, 1e-12);
}

TEST(Scaling, WhatDoesNotFitIsTheNearestNumber) {
  const Scaling scaling;
  EXPECT_EQ(scaling.raw_position(1e30), 2147483647);
  EXPECT_EQ(scaling.raw_torque(-1e30), -32768);
  EXPECT_EQ(scaling.raw_torque(std::numeric_limits<double>::quiet_NaN()), 0);
}

TEST(Scaling, AFactorOfZeroIsNamed) {
  EXPECT_EQ(Scaling::make({.gear_shaft = 0}, PositionUnit::kIncrements).error(),
            "object 0x6091:02, shaft revolutions is 0, expected a number above 0 (set it in the "
            "drive)");
}

}  // namespace
}  // namespace armature::cia402
