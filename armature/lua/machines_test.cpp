// SPDX-License-Identifier: Apache-2.0
// State machines that a script defines: the same rules as those of components.
#include "armature/lua/internal/test_bench.hpp"

namespace armature::lua::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class MachineOfAScript : public ::testing::Test {
 protected:
  std::string run(const std::string& text, base::Duration duration = 10s) {
    return bench.run(text, duration);
  }
  Bench bench;
};

/// Writes what is entered and left.
constexpr const char* kNoting =
    "local function note(text) return function(...) print(text, ...) end end\n";

TEST_F(MachineOfAScript, LeavesInnerFirstActsAndEntersOuterFirst) {
  EXPECT_EQ(run(std::string(kNoting) +
                "local m = machine {\n"
                "  name = 'Work', initial = 'A',\n"
                "  A = {initial = 'Inner', entry = note('+A'), exit = note('-A'),\n"
                "       on = {go = {'B/Deep', action = note('act')}},\n"
                "       Inner = {entry = note('+A/Inner'), exit = note('-A/Inner')}},\n"
                "  B = {initial = 'Other', entry = note('+B'),\n"
                "       Other = {}, Deep = {entry = note('+B/Deep')},\n"
                "       on = {turn = 'Other'}},\n"
                "}\n"
                "print(m, m.state, m.running)\n"
                "m:start()\n"
                "print(m.state, m:is_in('A'), m:is_in('B'), m.running)\n"
                "print(m:send('go', 1, 'x'))\n"
                "print(m, m:send('turn'), m.state)\n"
                "print(m:send('go'))\n"
                "m:stop()\n"
                "print(m.state, m:send('go'))\n"
                "stop()"),
            "");
  EXPECT_THAT(bench.lines,
              ElementsAre("machine 'Work' (not running)\t\tfalse", "+A", "+A/Inner",
                          "A/Inner\ttrue\tfalse\ttrue", "-A/Inner", "-A", "act\t1\tx", "+B",
                          "+B/Deep", "true", "+B", "machine 'Work' (B/Other)\ttrue\tB/Other",
                          "false\tignored", "\tfalse\tnot running"));
}

TEST_F(MachineOfAScript, GoesOnByTimeAtTheExactInstant) {
  EXPECT_EQ(run("local m = machine {\n"
                "  initial = 'Left',\n"
                "  Left = {entry = function() print('left', now()) end, after = {0.25, 'Right'}},\n"
                "  Right = {entry = function() print('right', now()) end, after = {1, 'Left'}},\n"
                "}\n"
                "m:start()\nwait(2.6)\nstop()"),
            "");
  EXPECT_THAT(bench.lines,
              ElementsAre("left\t0.0", "right\t0.25", "left\t1.25", "right\t1.5", "left\t2.5"));
}

TEST_F(MachineOfAScript, AsksConditionsAndActsDuringAStateInItsPeriod) {
  EXPECT_EQ(run("local m = machine {\n"
                "  period = 0.02, initial = 'Going',\n"
                "  Going = {entry = function() Axis:moveTo(5) end,\n"
                "           during = function() print(now(), Axis.Position) end,\n"
                "           when = {function() return Axis.Position >= 4 end, 'There'}},\n"
                "  There = {final = true},\n"
                "}\n"
                "m:start()\nprint(wait(m))\nprint(now(), m.state, m.running)\nstop()"),
            "");
  EXPECT_THAT(bench.lines, ElementsAre("0.02\t2.0", "true", "0.04\tThere\tfalse"));
}

TEST_F(MachineOfAScript, TriesAlternativesInTheirOrderAndAsksTheirGuards) {
  EXPECT_EQ(run("local limit = 10\n"
                "local m = machine {\n"
                "  initial = 'A',\n"
                "  A = {on = {go = {{'B', guard = function(x) return x > limit end},\n"
                "                   {'C', guard = function(x) return x < 0 end}},\n"
                "             note = function(x) print('noted', x) end}},\n"
                "  B = {on = {go = 'A'}}, C = {on = {go = 'A'}},\n"
                "}\n"
                "m:start()\n"
                "print(m:send('go', 5), m.state)\n"
                "print(m:send('go', -5), m.state)\n"
                "print(m:send('go'), m.state)\n"
                "print(m:send('go', 11), m.state)\n"
                "m:send('go') m:send('note', 7) print(m.state)\n"
                "stop()"),
            "");
  EXPECT_THAT(bench.lines,
              ElementsAre("false\tA", "true\tC", "true\tA", "true\tB", "noted\t7", "A"));
}

TEST_F(MachineOfAScript, RunsWhatTakesTimeAndGoesOnWhenItIsDone) {
  EXPECT_EQ(run("local m = machine {\n"
                "  initial = 'Out',\n"
                "  Out = {run = function() assert(wait(Axis:moveTo(5))) end, done = 'Back'},\n"
                "  Back = {run = function() assert(wait(Axis:moveTo(2))) end, done = 'End'},\n"
                "  End = {final = true},\n"
                "}\n"
                "m:start()\nprint(wait(m))\nprint(now(), Axis.Position, m.state)\nstop()"),
            "");
  EXPECT_THAT(bench.lines, ElementsAre("true", "0.08\t2.0\tEnd"));
}

TEST_F(MachineOfAScript, RecoversFromARunThatFails) {
  EXPECT_EQ(run("local m = machine {\n"
                "  initial = 'Work',\n"
                "  Work = {\n"
                "    initial = 'Far',\n"
                "    failed = {'Safe', action = function(why) print(why) end},\n"
                "    Far = {run = function() Axis:moveTo(-1) end, done = 'Near'},\n"
                "    Near = {},\n"
                "  },\n"
                "  Safe = {after = {0.5, 'End'}},\n"
                "  End = {final = true},\n"
                "}\n"
                "m:start()\nprint(wait(m), now())\nstop()"),
            "");
  EXPECT_THAT(bench.lines, ElementsAre("Axis.moveTo: the target is outside the axis", "true\t0.5"));
}

TEST_F(MachineOfAScript, EndsTheScriptIfARunFailsThatNobodyExpects) {
  EXPECT_EQ(run("machine {A = {run = function()\n  Axis:moveTo(-1)\nend}}:start()\nwait(5)"),
            "robot.lua:2: error: Axis.moveTo: the target is outside the axis\n");
}

TEST_F(MachineOfAScript, EndsARunWhenItsStateIsLeft) {
  EXPECT_EQ(run("local m = machine {\n"
                "  initial = 'Counting',\n"
                "  Counting = {run = function() while true do wait(0.1) print(now()) end end,\n"
                "              on = {pause = 'Paused'}},\n"
                "  Paused = {on = {resume = 'Counting'}},\n"
                "}\n"
                "m:start()\n"
                "wait(0.25) m:send('pause') wait(1) m:send('resume') wait(0.15) stop()"),
            "");
  EXPECT_THAT(bench.lines, ElementsAre("0.1", "0.2", "1.35"));
}

TEST_F(MachineOfAScript, EndsARunThatLeavesItsOwnStateAtItsNextWait) {
  EXPECT_EQ(run("local m m = machine {\n"
                "  initial = 'A',\n"
                "  A = {run = function() m:send('go') print('still here') wait(0.1)\n"
                "         print('not reached') end, on = {go = 'B'}},\n"
                "  B = {},\n"
                "}\n"
                "m:start() wait(1) print(m.state) stop()"),
            "");
  EXPECT_THAT(bench.lines, ElementsAre("still here", "B"));
}

TEST_F(MachineOfAScript, ReturnsToWhereItWasLeft) {
  EXPECT_EQ(run("local m = machine {\n"
                "  initial = 'Work',\n"
                "  Work = {initial = 'One', One = {on = {next = 'Two'}}, Two = {},\n"
                "          on = {pause = 'Paused'}},\n"
                "  Paused = {on = {resume = {back_to = 'Work'}, again = 'Work'}},\n"
                "}\n"
                "m:start()\n"
                "m:send('next') m:send('pause') m:send('resume') print(m.state)\n"
                "m:send('pause') m:send('again') print(m.state)\n"
                "stop()"),
            "");
  EXPECT_THAT(bench.lines, ElementsAre("Work/Two", "Work/One"));
}

TEST_F(MachineOfAScript, IsDoneOnceAFinalStateInItIsEntered) {
  EXPECT_EQ(run("local m = machine {\n"
                "  initial = 'Work',\n"
                "  Work = {initial = 'One', One = {after = {0.1, 'Over'}}, Over = {final = true},\n"
                "          done = 'End'},\n"
                "  End = {final = true, entry = function() print('end', now()) end},\n"
                "}\n"
                "m:start()\nprint(wait(m), m.state)\n"
                "m:start()\nprint(m.state)\nat(now() + 0.05, function() m:stop() end)\n"
                "print(wait(m))\nstop()"),
            "");
  EXPECT_THAT(bench.lines,
              ElementsAre("end\t0.1", "true\tEnd", "Work/One", "false\tthe machine was stopped"));
}

TEST_F(MachineOfAScript, HandlesWhatAnActionSendsAfterThePresentTransition) {
  EXPECT_EQ(run("local m m = machine {\n"
                "  initial = 'A',\n"
                "  A = {on = {go = 'B'}, exit = function() print(m:send('back')) end},\n"
                "  B = {entry = function() print('B') end, on = {back = 'C'}},\n"
                "  C = {entry = function() print('C') end},\n"
                "}\n"
                "m:start() m:send('go') print(m.state) stop()"),
            "");
  EXPECT_THAT(bench.lines, ElementsAre("true", "B", "C", "C"));
}

TEST_F(MachineOfAScript, LeavesItsStatesWhenTheScriptEnds) {
  EXPECT_EQ(run("machine {A = {exit = function() print('left A') end}}:start()", 2s), "");
  EXPECT_THAT(bench.lines, ElementsAre("left A"));
  EXPECT_EQ(bench.ended(), exec::RunEnd::kTimeUp);
  EXPECT_EQ(bench.application().now(), base::Time{} + 2s);
}

TEST_F(MachineOfAScript, MayStopTheApplicationFromAnAction) {
  EXPECT_EQ(run("local m m = machine {\n"
                "  initial = 'A', A = {after = {0.5, 'B'}},\n"
                "  B = {entry = function() pcall(stop) print('not reached') end},\n"
                "}\n"
                "m:start() wait(5)"),
            "");
  EXPECT_EQ(bench.ended(), exec::RunEnd::kStopRequested);
  EXPECT_EQ(bench.application().now(), base::Time{} + 500ms);
  EXPECT_TRUE(bench.lines.empty());
}

// --- mistakes while it runs ----------------------------------------------------------------------

TEST_F(MachineOfAScript, EndsTheScriptByAMistakeInAnActionAndLeavesItsStates) {
  EXPECT_EQ(run("local m = machine {\n"
                "  initial = 'A', A = {after = {1, 'B'}},\n"
                "  B = {entry = function()\n    local x = nil + 1\n  end,\n"
                "       exit = function() print('left') end}}\n"
                "m:start() wait(5)"),
            "robot.lua:4: error: attempt to perform arithmetic on a nil value\n");
  EXPECT_EQ(bench.application().now(), base::Time{} + 1s);
}

TEST_F(MachineOfAScript, GivesAMistakeToWhoSentWhatCausedItAndMayBeStartedAgain) {
  EXPECT_EQ(run("local m = machine {\n"
                "  initial = 'A', A = {on = {go = 'B'}},\n"
                "  B = {entry = function() error('broken') end}}\n"
                "m:start()\n"
                "print(pcall(function() m:send('go') end))\n"
                "print(m.state, m.running)\n"
                "m:start() print(m.state)\nstop()"),
            "");
  EXPECT_THAT(bench.lines, ElementsAre("false\trobot.lua:3: broken", "\tfalse", "A"));
}

TEST_F(MachineOfAScript, ThatNeverRestsIsEnded) {
  EXPECT_EQ(run("local m m = machine {\n"
                "  A = {on = {go = {'A', action = function() m:send('go') end}}}}\n"
                "m:start()\n"
                "m:send('go')"),
            "robot.lua:4: error: machine 'machine': state machine 'machine' does not come to "
            "rest\n");
}

TEST_F(MachineOfAScript, CannotBeStartedByAnActionOfItsOwn) {
  EXPECT_EQ(run("local m m = machine {A = {exit = function()\n  m:start()\nend}}\n"
                "m:start()\nm:stop()"),
            "robot.lua:2: error: machine 'machine' cannot be started by an action of its own\n");
}

TEST_F(MachineOfAScript, MayBeStoppedByAnActionOfItsOwn) {
  EXPECT_EQ(run("local m m = machine {A = {entry = function() print('in') m:stop() end,\n"
                "  exit = function() print('out') end, on = {go = 'A'}}}\n"
                "m:start() print(m) stop()"),
            "");
  EXPECT_THAT(bench.lines, ElementsAre("in", "machine 'machine' (not running)"));
}

TEST_F(MachineOfAScript, WhoseActionNeverEndsIsEndedWithItsLine) {
  bench.time_limit = 50ms;
  EXPECT_THAT(run("machine {A = {during = function()\n  while true do end\nend}}:start() wait(5)"),
              HasSubstr("robot.lua:2: error: the script has run for more than 0.05 s"));
}

TEST_F(MachineOfAScript, CannotWaitInAnAction) {
  EXPECT_EQ(run("machine {A = {entry = function()\n  wait(1)\nend}}:start()"),
            "robot.lua:2: error: an action of a machine cannot wait: put what takes time into its "
            "`run`\n");
}

TEST_F(MachineOfAScript, OfTwoSimulatedRunsGoesTheSameWay) {
  const char* const kScript =
      "local m m = machine {\n"
      "  period = 0.03, initial = 'A',\n"
      "  A = {initial = 'X', X = {run = function() wait(math.random()) end, done = 'Y'}, Y = {},\n"
      "       after = {0.5, 'B'}, when = {function() return Axis.Position == 3 end, 'C'}},\n"
      "  B = {entry = function() Axis:moveTo(math.random(2, 4)) end, after = {0.2, 'A'}},\n"
      "  C = {after = {0.3, 'B'}},\n"
      "}\n"
      "m:start()\n"
      "for i = 1, 100 do wait(0.05) print(now(), m.state, Axis.Position) end stop()";
  Bench other;
  EXPECT_EQ(run(kScript), "");
  EXPECT_EQ(other.run(kScript), "");
  EXPECT_EQ(bench.lines.size(), 100u);
  EXPECT_EQ(bench.lines, other.lines);
}

}  // namespace
}  // namespace armature::lua::test
