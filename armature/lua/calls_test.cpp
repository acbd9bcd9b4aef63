// SPDX-License-Identifier: Apache-2.0
// Operations, commands and acts of the operator, called by a script.
#include "armature/lua/internal/test_bench.hpp"

namespace armature::lua::test {
namespace {

using ::testing::ElementsAre;

TEST(Calls, OfOperationsGiveTheirResult) {
  Bench bench;
  EXPECT_EQ(bench.run("print(Settings:sum(array(1.0, 2.0), 10))\n"
                      "print(Settings:twice({1, 2}))\n"
                      "print(Settings.Calls)\n"
                      "stop()"),
            "");
  EXPECT_THAT(bench.lines, ElementsAre("30.0", "[1.0, 2.0, 1.0, 2.0]", "1"));
}

TEST(Calls, OfCommandsGiveAHandle) {
  Bench bench;
  EXPECT_EQ(bench.run("local move = Axis:moveTo(4)\n"
                      "print(move:done(), move:progress(), move:reason(), move)\n"
                      "wait(0.02)\n"
                      "print(move:done(), move:progress())\n"
                      "print(wait(move))\n"
                      "print(move:done(), move:progress(), move:reason(), move)\n"
                      "print(wait(move))\n"
                      "stop()"),
            "");
  EXPECT_THAT(bench.lines, ElementsAre("false\t0.0\t\tAxis.moveTo (under way)", "false\t0.5",
                                       "true", "true\t1.0\t\tAxis.moveTo (done)", "true"));
}

TEST(Calls, OfCommandsThatFailSayWhy) {
  Bench bench;
  EXPECT_EQ(bench.run("local move = Axis:moveTo(20)\n"
                      "print(wait(move))\n"
                      "print(move:done(), move:reason())\n"
                      "stop()"),
            "");
  EXPECT_THAT(bench.lines, ElementsAre("false\tthe axis is stuck", "true\tthe axis is stuck"));
}

TEST(Calls, OfCommandsAreCancelled) {
  Bench bench;
  EXPECT_EQ(bench.run("local move = Axis:moveTo(10)\n"
                      "wait(0.025)\n"
                      "move:cancel()\n"
                      "print(wait(move))\n"
                      "wait(0.1)\n"
                      "print(Axis.Position)\n"
                      "assert(wait(Axis:moveTo(10)))\n"
                      "stop()"),
            "");
  EXPECT_THAT(bench.lines, ElementsAre("false\tcancelled by its sender", "2.0"));
}

TEST(Calls, OfOperationsThatThrowSayWhat) {
  Bench bench;
  EXPECT_EQ(bench.run("Settings:fail()"),
            "robot.lua:1: error: Settings.fail: fail: failed: exception: it broke\n");
}

TEST(Calls, OfCommandsOfAComponentThatRestsAreRefused) {
  Bench bench;
  EXPECT_TRUE(bench.application().stop_component("Axis"));
  EXPECT_EQ(bench.run("Axis:moveTo(1)"),
            "robot.lua:1: error: Axis.moveTo: the component is not running\n");
}

struct Refusal {
  const char* script;
  const char* text;
};

class Calling : public ::testing::TestWithParam<Refusal> {};

TEST_P(Calling, IsRefusedWithTheReasonAndTheLine) {
  Bench bench;
  EXPECT_EQ(bench.run(std::string("\n\n") + GetParam().script),
            std::string("robot.lua:3: error: ") + GetParam().text + "\n");
  EXPECT_EQ(bench.ended(), exec::RunEnd::kStopRequested);
}

INSTANTIATE_TEST_SUITE_P(
    Each, Calling,
    ::testing::Values(
        Refusal{"Axis:moveTo(-1)", "Axis.moveTo: the target is outside the axis"},
        Refusal{"Axis:moveTo(5); Axis:moveTo(6)",
                "Axis.moveTo: the previous command is still under way, and this command does not "
                "queue"},
        Refusal{"Axis:moveTo()",
                "Axis.moveTo takes 1 argument, not 0: it is void(double target [m])"},
        Refusal{"Axis:moveTo(1, 2)",
                "Axis.moveTo takes 1 argument, not 2: it is void(double target [m])"},
        Refusal{"Axis:moveTo('there')",
                "Axis.moveTo: argument 1 (target [m]) must be a number, found the text 'there'"},
        Refusal{"Axis.moveTo(1)", "Axis.moveTo is called with a colon: Axis:moveTo(...)"},
        Refusal{
            "Axis:moveto(1)",
            "'Axis' has no property, port, operation or event 'moveto' (did you mean 'moveTo'?)"},
        Refusal{"Axsi:moveTo(1)", "unknown component or variable 'Axsi' (did you mean 'Axis'?)"},
        Refusal{"Settings:sum({1, {}}, 1)",
                "Settings.sum: argument 1 (values [rad])[2] must be a number, found a table"},
        Refusal{"Axis:arm()",
                "'Axis.arm' is an act of the operator: a script may use it only if the deployment "
                "grants it (grants: {script: [Axis.arm]})"},
        Refusal{"local ok, why = pcall(function() Axis:moveTo(-1) end)\nerror(why, 0)",
                "Axis.moveTo: the target is outside the axis"},
        Refusal{"error('I give up')", "I give up"}, Refusal{"error({code = 5})", "{code: 5}"},
        Refusal{"assert(false, 'not there')", "not there"},
        Refusal{
            "wait(Axis)",
            "wait takes a number of seconds above 0, a command, an event or a machine, found Axis"},
        Refusal{"wait()",
                "wait takes a number of seconds above 0, a command, an event or a machine, found "
                "nothing"},
        Refusal{
            "wait(0)",
            "wait takes a number of seconds above 0, a command, an event or a machine, found 0"},
        Refusal{
            "wait(-1)",
            "wait takes a number of seconds above 0, a command, an event or a machine, found -1"},
        Refusal{"at(-1, print)", "at takes a number of seconds from 0 on, found -1"},
        Refusal{"at(1)", "at takes a time and a function: at(5.0, function() ... end)"}));

TEST(Calls, MayDoWhatTheDeploymentGrants) {
  Bench bench(true, {{exec::Caller::kScript, "Axis", "arm"}});
  EXPECT_EQ(bench.run("print(wait(Axis:arm()))\nstop()"), "");
  EXPECT_THAT(bench.lines, ElementsAre("true"));
}

TEST(Calls, ThatAreRefusedCanBeCaught) {
  Bench bench;
  EXPECT_EQ(bench.run("local ok, why = pcall(function() Axis:moveTo(-1) end)\n"
                      "print(ok, why)\n"
                      "print(pcall(function() return wait(Axis:moveTo(3)) end))\n"
                      "stop()"),
            "");
  EXPECT_THAT(
      bench.lines,
      ElementsAre("false\trobot.lua:1: Axis.moveTo: the target is outside the axis", "true\ttrue"));
}

}  // namespace
}  // namespace armature::lua::test
