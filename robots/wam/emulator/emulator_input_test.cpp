// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/emulator/emulator_input.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::wam {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(EmulatorInput, OfAnotherProgramIsLines) {
  EmulatorInput input(EmulatorInput::Kind::kLines);
  EXPECT_THAT(input.take("rele"), IsEmpty());
  EXPECT_THAT(input.take("ase\nidle\r\n\n  \nfault puck 3"), ElementsAre("release", "idle"));
  EXPECT_THAT(input.take(" silent\n"), ElementsAre("fault puck 3 silent"));
}

TEST(EmulatorInput, ALineIsCutAfterTwoHundredLetters) {
  EmulatorInput input(EmulatorInput::Kind::kLines);
  EXPECT_THAT(input.take(std::string(5000, 'x')), IsEmpty());
  EXPECT_THAT(input.take("\nidle\n"),
              ElementsAre(std::string(EmulatorInput::kMostLetters, 'x'), "idle"));
}

TEST(EmulatorInput, AtATerminalAKeyIsACommand) {
  EmulatorInput input(EmulatorInput::Kind::kKeys);
  EXPECT_THAT(input.take("ri"), ElementsAre("release", "idle"));
  EXPECT_THAT(input.take("aehq?"), ElementsAre("activate", "estop", "home", "quit", "help"));
  EXPECT_THAT(input.take("xyz\n AE"), IsEmpty());
}

TEST(EmulatorInput, AColonBeginsALine) {
  EmulatorInput input(EmulatorInput::Kind::kKeys);
  EXPECT_THAT(input.take(":fault puck 3 silenx"), IsEmpty());
  EXPECT_TRUE(input.in_line());
  EXPECT_EQ(input.line(), "fault puck 3 silenx");
  EXPECT_THAT(input.take("\x7ft\r"), ElementsAre("fault puck 3 silent"));
  EXPECT_FALSE(input.in_line());
  EXPECT_THAT(input.take("e"), ElementsAre("estop"));
}

TEST(EmulatorInput, EscapeGivesALineUp) {
  EmulatorInput input(EmulatorInput::Kind::kKeys);
  EXPECT_THAT(input.take(":activate\x1b"), IsEmpty());
  EXPECT_FALSE(input.in_line());
  EXPECT_THAT(input.take("i"), ElementsAre("idle"));
}

TEST(EmulatorInput, ArrowsAndFunctionKeysAreNoCommands) {
  EmulatorInput input(EmulatorInput::Kind::kKeys);
  EXPECT_THAT(input.take("\x1b[A\x1b[a\x1b[15~\x1bOa\x1b[1;2a"), IsEmpty());
  EXPECT_THAT(input.take("\x1bi"), ElementsAre("idle"));
}

}  // namespace
}  // namespace armature::wam
