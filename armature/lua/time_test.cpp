// SPDX-License-Identifier: Apache-2.0
// When what of a script runs.
#include "armature/lua/internal/test_bench.hpp"

namespace armature::lua::test {
namespace {

using exec::RunEnd;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(Time, OfAtAndWaitIsExactInSimulatedTime) {
  Bench bench;
  EXPECT_EQ(bench.run("at(0.5, function() Axis:moveTo(1) end)\n"
                      "at(0.123456789, function() Axis:moveTo(0) end)\n"
                      "wait(0.75)\n"
                      "Axis:moveTo(2)\n"
                      "wait(0.25)\n"
                      "print(now())\n"
                      "stop()"),
            "");
  EXPECT_THAT(bench.axis().told_at, ElementsAre(123456789ns, 500ms, 750ms));
  EXPECT_THAT(bench.lines, ElementsAre("1.0"));
  EXPECT_EQ(bench.application().now(), base::Time{} + 1s);
}

TEST(Time, OfACommandsEndIsTheInstantAtWhichItEnded) {
  Bench bench;
  EXPECT_EQ(bench.run("Axis:moveTo(5)\n"
                      "local move = Axis:moveTo(0)\n"),
            "robot.lua:2: error: Axis.moveTo: the previous command is still under way, and "
            "this command does not queue\n");
  Bench other;
  EXPECT_EQ(other.run("assert(wait(Axis:moveTo(5)))\nprint(now())\nstop()"), "");
  EXPECT_THAT(other.lines, ElementsAre("0.05")) << "a step at each of 10, 20, 30, 40, 50 ms";
}

TEST(Time, AtOneInstantWhatWasMadeFirstComesFirst) {
  Bench bench;
  EXPECT_EQ(bench.run("at(1, function() print('a') at(now(), function() print('d') end) end)\n"
                      "at(0.5, function() print('0') end)\n"
                      "at(1, function() print('b') end)\n"
                      "at(1, function() print('c') end)\n"
                      "wait(2)\n"
                      "stop()"),
            "");
  EXPECT_THAT(bench.lines, ElementsAre("0", "a", "b", "c", "d"));
}

TEST(Time, OfSeveralPartsGoesOnSideBySide) {
  Bench bench;
  EXPECT_EQ(bench.run("at(0, function()\n"
                      "  for i = 1, 3 do wait(0.1) print('part', i, now()) end\n"
                      "end)\n"
                      "for i = 1, 2 do wait(0.15) print('main', i, now()) end\n"
                      "wait(1)\n"
                      "stop()"),
            "");
  EXPECT_THAT(bench.lines, ElementsAre("part\t1\t0.1", "main\t1\t0.15", "part\t2\t0.2",
                                       "main\t2\t0.3", "part\t3\t0.3"));
}

TEST(Time, ThatHasPassedIsRefused) {
  Bench bench;
  EXPECT_EQ(bench.run("wait(2.5)\nat(1, function() end)"),
            "robot.lua:2: error: at(1) is too late: 2.5 s have passed since the script began\n");
}

TEST(Time, OfTheRunEndsItAlsoWhileTheScriptWaits) {
  Bench bench;
  EXPECT_EQ(bench.run("wait(5) print('late')", 3s), "");
  EXPECT_EQ(bench.ended(), RunEnd::kTimeUp);
  EXPECT_EQ(bench.application().now(), base::Time{} + 3s);
  EXPECT_TRUE(bench.lines.empty());
}

TEST(Time, GoesOnWhenTheScriptIsOver) {
  Bench bench;
  EXPECT_EQ(bench.run("print('over')", 3s), "");
  EXPECT_EQ(bench.ended(), RunEnd::kTimeUp);
  EXPECT_EQ(bench.application().now(), base::Time{} + 3s);
}

TEST(Time, IsOverWhenTheScriptStops) {
  Bench bench;
  EXPECT_EQ(bench.run("at(1, function() pcall(stop) print('not reached') end) wait(5)"), "");
  EXPECT_EQ(bench.ended(), RunEnd::kStopRequested);
  EXPECT_EQ(bench.application().now(), base::Time{} + 1s);
  EXPECT_TRUE(bench.lines.empty());
}

TEST(Time, StandingStillByAtIsRefused) {
  Bench bench;
  EXPECT_EQ(bench.run("local function again() at(now(), again) end again()"),
            "robot.lua: error: `at`, events or machines call each other without end at one "
            "instant: let time pass between them\n");
}

TEST(Time, CannotPassInAFunctionThatLuaItselfCalls) {
  Bench bench;
  EXPECT_EQ(bench.run("table.sort({1, 2}, function() wait(1) end)"),
            "robot.lua:1: error: a function that Lua itself calls cannot wait\n");
}

TEST(Time, OfTwoSimulatedRunsIsTheSameToTheBit) {
  const char* const kScript =
      "local all = {}\n"
      "for i = 1, 50 do all['key' .. i] = math.random() end\n"
      "for key, value in pairs(all) do print(key, string.format('%a', value)) end\n"
      "for i = 1, 20 do\n"
      "  wait(math.random() + 0.001)\n"
      "  local move = Axis:moveTo(math.random(0, 10))\n"
      "  wait(0.05) move:cancel() print(wait(move)) print(now(), Axis.Position)\n"
      "end\n"
      "stop()";
  Bench first;
  Bench second;
  EXPECT_EQ(first.run(kScript, 100s), "");
  EXPECT_EQ(second.run(kScript, 100s), "");
  EXPECT_EQ(first.lines.size(), 90u);
  EXPECT_EQ(first.lines, second.lines);
  EXPECT_EQ(first.axis().told_at, second.axis().told_at);
}

TEST(Time, IsTheMachinesInARealRun) {
  Bench bench(false);
  EXPECT_EQ(bench.run("local begin = now()\n"
                      "at(0.03, function() print('at') end)\n"
                      "wait(0.02)\n"
                      "assert(now() >= begin + 0.02)\n"
                      "print(wait(Axis:moveTo(5)))\n"
                      "Settings.Gain = 7\n"
                      "print(Settings.Gain, Axis.Position, Settings:sum({1, 2}, 2))\n"
                      "stop()",
                      60s),
            "");
  EXPECT_EQ(bench.ended(), RunEnd::kStopRequested);
  EXPECT_THAT(bench.lines, ElementsAre("at", "true", "7.0\t5.0\t6.0"));
}

}  // namespace
}  // namespace armature::lua::test
