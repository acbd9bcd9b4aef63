// SPDX-License-Identifier: Apache-2.0
// Properties, attributes and ports as a script sees them.
#include "armature/lua/internal/test_bench.hpp"

namespace armature::lua::test {
namespace {

using ::testing::ElementsAre;

TEST(Values, OfEveryKindAreRead) {
  Bench bench;
  EXPECT_EQ(bench.run("print(Settings.Loud, Settings.Count, Settings.Gain, Settings.Label)\n"
                      "print(Settings.Offsets, Settings.Limits, Settings.Gains)\n"
                      "print(Settings.Offsets[2], Settings.Limits[3], Settings.Gains.kp)\n"
                      "print(Axis.Position, Axis.Both[2], Settings.Calls)\n"
                      "print(math.type(Settings.Count), math.type(Settings.Gain))\n"
                      "stop()"),
            "");
  EXPECT_THAT(bench.lines,
              ElementsAre("false\t3\t2.5\tleft", "[0.5, -1.0]\t[1, 2, 3]\t{kp: 0.0, steps: 1}",
                          "-1.0\t3\t0.0", "0.0\t0.0\t0", "integer\tfloat"));
}

TEST(Values, OfEveryKindAreWritten) {
  Bench bench;
  EXPECT_EQ(bench.run("Settings.Loud = true\n"
                      "Settings.Count = 7.0\n"
                      "Settings.Byte = 255\n"
                      "Settings.Gain = 4\n"
                      "Settings.Label = 'right'\n"
                      "Settings.Offsets = array(1, 2.5)\n"
                      "Settings.Limits = {4, 5, 6}\n"
                      "Settings.Gains = {kp = 0.1, steps = 2}\n"
                      "stop()"),
            "");
  EXPECT_TRUE(bench.settings().loud.get());
  EXPECT_EQ(bench.settings().count.get(), 7);
  EXPECT_EQ(bench.settings().byte.get(), 255);
  EXPECT_EQ(bench.settings().gain.get(), 4.0);
  EXPECT_EQ(bench.settings().label.get(), "right");
  EXPECT_THAT(bench.settings().offsets.get(), ElementsAre(1.0, 2.5));
  EXPECT_THAT(bench.settings().limits.get(), ElementsAre(4, 5, 6));
  EXPECT_EQ(bench.settings().gains.get().kp, 0.1) << "to the bit";
  EXPECT_EQ(bench.settings().gains.get().steps, 2);
}

struct Refusal {
  const char* script;
  const char* text;
};

class Writing : public ::testing::TestWithParam<Refusal> {};

TEST_P(Writing, IsRefusedWithTheReasonAndTheLine) {
  Bench bench;
  EXPECT_EQ(bench.run(std::string("\n") + GetParam().script),
            std::string("robot.lua:2: error: ") + GetParam().text + "\n");
  EXPECT_EQ(bench.settings().count.get(), 3);
  EXPECT_EQ(bench.settings().byte.get(), 0);
}

INSTANTIATE_TEST_SUITE_P(
    Each, Writing,
    ::testing::Values(
        Refusal{"Settings.Loud = 1", "Settings.Loud must be true or false, found 1"},
        Refusal{"Settings.Count = 2.5", "Settings.Count must be a whole number, found 2.5"},
        Refusal{"Settings.Count = '5'",
                "Settings.Count must be a whole number, found the text '5'"},
        Refusal{"Settings.Count = 11", "property 'Count' of 'Settings' is 11, outside 0 .. 10"},
        Refusal{"Settings.Byte = 256", "Settings.Byte must be in the range of uint8, found 256"},
        Refusal{"Settings.Byte = -1", "Settings.Byte must be in the range of uint8, found -1"},
        Refusal{"Settings.Gain = nil", "Settings.Gain must be a number, found nothing"},
        Refusal{"Settings.Gain = Axis", "Settings.Gain must be a number, found Axis"},
        Refusal{"Settings.Label = 5", "Settings.Label must be a text, found 5"},
        Refusal{"Settings.Offsets = 1", "Settings.Offsets must be a list, found 1"},
        Refusal{"Settings.Offsets = {1, 'x'}",
                "Settings.Offsets[2] must be a number, found the text 'x'"},
        Refusal{"Settings.Offsets = {a = 1}",
                "Settings.Offsets must be a list, found a table with other keys, or with gaps"},
        Refusal{"Settings.Limits = {1, 2}",
                "Settings.Limits must be a list of 3 elements, found 2"},
        Refusal{"Settings.Gains = {kp = 1}",
                "Settings.Gains.steps must be a whole number, found nothing"},
        Refusal{"Settings.Gains = {kp = 1, stesp = 2}",
                "Settings.Gains has no field 'stesp' (did you mean 'steps'?)"},
        Refusal{
            "Settings.Fixed = 2",
            "property 'Fixed' of 'Settings' cannot change while the component runs; stop it first"},
        Refusal{"Settings.Gian = 2", "'Settings' has no property 'Gian' (did you mean 'Gain'?)"},
        Refusal{"Axis.Position = 2", "'Axis.Position' is a port: only components write it"},
        Refusal{"Axis = 2", "'Axis' is a component: give your variable another name"},
        Refusal{
            "print(Settings.Gian)",
            "'Settings' has no property, port, operation or event 'Gian' (did you mean 'Gain'?)"},
        Refusal{"print(Setings.Gain)",
                "unknown component or variable 'Setings' (did you mean 'Settings'?)"},
        Refusal{"prnt(1)", "unknown component or variable 'prnt' (did you mean 'print'?)"}));

TEST(Values, OfEnumerationsAreTheirNames) {
  Bench bench;
  EXPECT_EQ(bench.run("print(Settings.Stance)\nSettings.Stance = 'holding'\nstop()"), "");
  EXPECT_THAT(bench.lines, ElementsAre("free"));
  EXPECT_EQ(bench.settings().stance.get(), Stance::kHolding);
}

TEST(Values, OfAPartOfACompositeAreReachedByItsName) {
  Bench bench;
  EXPECT_EQ(bench.run("left.hand.Finger.Gain = 8\n"
                      "print(left.hand.Finger.Gain, left.hand.Finger)\n"
                      "print(left.hand.Fingr.Gain)"),
            "robot.lua:3: error: unknown component or variable 'Fingr' (did you mean "
            "'Finger'?)\n");
  EXPECT_THAT(bench.lines, ElementsAre("8.0\tleft.hand.Finger"));
}

TEST(Values, OfAScriptsOwnArePrintedForPeople) {
  Bench bench;
  EXPECT_EQ(bench.run("local all = {1, {x = 'a', b = true}, {}}\n"
                      "print(all, 'text', nil)\n"
                      "all[4] = all\n"
                      "print(#tostring(all) > 0)\n"
                      "print(all)\n"
                      "stop()"),
            "");
  EXPECT_EQ(bench.lines.at(0), "[1, {b: true, x: 'a'}, []]\ttext\tnil");
  EXPECT_THAT(bench.lines.at(2), ::testing::HasSubstr("..."));
}

}  // namespace
}  // namespace armature::lua::test
