// SPDX-License-Identifier: Apache-2.0
#include "armature/browser/internal/test_screen.hpp"

namespace armature::browser::test {
namespace {

TEST(Watch, WritesALineForEachStepOfSimulatedTime) {
  Desk desk;
  desk.type("m = Axis:moveTo(4)");
  EXPECT_EQ(desk.type("watch Axis.Position Axis.Both[2] every 0.01 for 0.03"),
            "      time  Axis.Position [m]  Axis.Both[2] [m]\n"
            "   0.010 s                  1                -1\n"
            "   0.020 s                  2                -2\n"
            "   0.030 s                  3                -3");
  EXPECT_EQ(desk.browser.prompt(), "application 0.03 s> ");
}

TEST(Watch, WritesTenLinesUnlessToldOtherwise) {
  Desk desk;
  desk.type("watch Axis.Position");
  EXPECT_EQ(desk.screen.lines.size(), 11u);
  EXPECT_EQ(desk.browser.prompt(), "application 2 s> ");
}

TEST(Watch, NamesTheItemsInEachLineWhereColumnsDoNotFit) {
  Desk desk;
  desk.screen.width = 40;
  EXPECT_EQ(desk.type("watch Axis.Position Settings.Gain every 1 for 1"),
            "   1.000 s  Axis.Position 0 m\n"
            "            Settings.Gain 2.5 V/rad");
}

TEST(Watch, IsNotOverwrittenByTheProgressOfCommands) {
  Desk desk(false);
  desk.screen.is_live = true;
  desk.screen.asks_until_key = 300;
  desk.type("m = Axis:moveTo(999)\nwatch Settings.Gain every 0.01");
  for (const std::string& shown : desk.screen.shown) {
    EXPECT_THAT(shown, ::testing::StartsWith("Settings.Gain"));
  }
}

TEST(Watch, EndsAtAKey) {
  Desk desk;
  desk.screen.is_live = true;
  desk.screen.asks_until_key = 100;
  desk.type("watch Axis.Position every 0.1 for 900");
  EXPECT_LT(desk.screen.lines.size(), 100u);
  EXPECT_FALSE(desk.screen.hears_keys);
}

TEST(Watch, EndsAtAnInterrupt) {
  Desk desk;
  desk.screen.asks_until_interrupt = 100;
  desk.type("watch Axis.Position every 0.1 for 900");
  EXPECT_LT(desk.screen.lines.size(), 100u);
  EXPECT_EQ(desk.type("1"), "1");
}

TEST(Watch, ShowsTheValuesInPlaceInRealTime) {
  Desk desk(false);
  desk.screen.is_live = true;
  desk.screen.asks_until_key = 5;
  EXPECT_EQ(desk.type("watch Settings.Gain Settings.Label every 0.01"),
            "Settings.Gain   2.5 V/rad\n"
            "Settings.Label  \"left\"");
  ASSERT_FALSE(desk.screen.shown.empty());
  EXPECT_EQ(desk.screen.shown.front(),
            "Settings.Gain   2.5 V/rad\n"
            "Settings.Label  \"left\"\n"
            "any key ends it");
}

}  // namespace
}  // namespace armature::browser::test
