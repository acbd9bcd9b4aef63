// SPDX-License-Identifier: Apache-2.0
// Events of components, as a script hears of them.
#include "armature/lua/internal/test_bench.hpp"

namespace armature::lua::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Strikes every 100 ms; `burst` times in the tenth of its cycles.
class Bell final : public Component {
 public:
  using Component::Component;

  int burst = 0;

 private:
  void on_update() override {
    ++cycle_;
    if (cycle_ == 10) {
      for (int i = 0; i < burst; ++i) rang_.raise();
    }
    if (cycle_ % 10 == 0) struck_.raise(cycle_ / 10, base::FixedText<8>("ding"), {1.0, 2.0});
  }

  Event<int, base::FixedText<8>, std::array<double, 2>> struck_{
      this, "Struck", "a stroke", {"count", "sound", "where [m]"}};
  Event<> rang_{this, "Rang", "many at once"};
  int cycle_ = 0;
};

class Events : public ::testing::Test {
 protected:
  std::string run(std::string_view text, base::Duration duration = 10s) {
    return bench.run(text, duration);
  }

  Bell* bell = nullptr;
  Bench bench{true, {}, [this](exec::Blueprint& blueprint) {
                bell = &blueprint.add<Bell>("Bell", exec::Activity::periodic(10ms));
                blueprint.components.back().model = "Bell";
              }};
};

TEST_F(Events, CallAFunctionWithTheirArguments) {
  EXPECT_EQ(run("on(Bell.Struck, function(count, sound, where)\n"
                "  print(now(), count, sound, where)\n"
                "end)\n"
                "wait(0.25) stop()"),
            "");
  EXPECT_THAT(bench.lines, ElementsAre("0.1\t1\tding\t[1.0, 2.0]", "0.2\t2\tding\t[1.0, 2.0]"));
}

TEST_F(Events, ReachEachOfSeveralFunctionsInTheirOrder) {
  EXPECT_EQ(run("on(Bell.Struck, function(n) print('a', n) end)\n"
                "on(Bell.Struck, function(n) wait(0.15) print('b', n, now()) end)\n"
                "on(Bell.Struck, function(n) print('c', n) end)\n"
                "wait(0.32) stop()"),
            "");
  EXPECT_THAT(bench.lines,
              ElementsAre("a\t1", "c\t1", "a\t2", "c\t2", "b\t1\t0.25", "a\t3", "c\t3"));
}

TEST_F(Events, AreNoLongerHeardOnceCancelled) {
  EXPECT_EQ(run("local bell bell = on(Bell.Struck, function(n)\n"
                "  print(n, bell)\n"
                "  if n == 2 then bell:cancel() bell:cancel() print(bell) end\n"
                "end)\n"
                "wait(1) stop()"),
            "");
  EXPECT_THAT(bench.lines, ElementsAre("1\tsubscription (active)", "2\tsubscription (active)",
                                       "subscription (cancelled)"));
}

TEST_F(Events, AreWaitedFor) {
  EXPECT_EQ(run("print(wait(Bell.Struck))\n"
                "print(now(), wait(Bell.Struck, 0.05))\n"
                "print(now(), wait(Bell.Struck, 0.05))\n"
                "print(Bell.Struck)\n"
                "stop()"),
            "");
  EXPECT_THAT(bench.lines, ElementsAre("true\t1\tding\t[1.0, 2.0]", "0.1\tfalse\tthe time is up",
                                       "0.15\ttrue\t2\tding\t[1.0, 2.0]", "Bell.Struck"));
}

TEST_F(Events, InAFunctionThatMakesAMistakeEndTheScriptWithItsLine) {
  EXPECT_EQ(run("on(Bell.Struck, function(n)\n  Axis:moveTo(-n)\nend)\nwait(5)"),
            "robot.lua:2: error: Axis.moveTo: the target is outside the axis\n");
  EXPECT_EQ(bench.application().now(), base::Time{} + 100ms);
}

TEST_F(Events, InAFunctionThatNeverEndsEndTheScriptWithItsLine) {
  bench.time_limit = 50ms;
  EXPECT_THAT(run("on(Bell.Struck, function()\n  while true do end\nend)\nwait(5)"),
              HasSubstr("robot.lua:2: error: the script has run for more than 0.05 s"));
}

TEST_F(Events, BeyondTheQueueAreLostAndTold) {
  bell->burst = 100;
  EXPECT_EQ(run("local count = 0\n"
                "on(Bell.Rang, function() count = count + 1 end)\n"
                "wait(1) print(count) stop()"),
            "robot.lua: warning: 36 of the events Bell.Rang were lost: more than 64 came before "
            "the script looked\n");
  EXPECT_THAT(bench.lines, ElementsAre("64"));
  EXPECT_EQ(bench.ended(), exec::RunEnd::kStopRequested);
}

TEST_F(Events, AreListenedToByAThousandAtMost) {
  EXPECT_EQ(run("for i = 1, 1001 do on(Bell.Struck, print) end"),
            "robot.lua:1: error: a script has at most 1000 functions and waits for events at once: "
            "cancel some\n");
}

TEST_F(Events, DoNotReachAScriptThatIsOver) {
  EXPECT_EQ(run("on(Bell.Struck, function() end) stop()"), "");
  bell->burst = 1000;
  bench.application().run_for(1s);
  EXPECT_EQ(run("print(wait(Bell.Struck)) stop()"), "");
  EXPECT_THAT(bench.lines, ElementsAre("true\t11\tding\t[1.0, 2.0]"));
}

TEST_F(Events, OfTwoSimulatedRunsComeTheSame) {
  const char* const kScript =
      "on(Bell.Struck, function(n) wait(math.random() * 0.2) print('on', n, now()) end)\n"
      "at(0, function() while true do print('wait', wait(Bell.Struck)) end end)\n"
      "for i = 1, 40 do wait(0.05) print(i, Axis:moveTo(i % 3), now()) wait(0.03) end\n"
      "stop()";
  EXPECT_EQ(run(kScript), "");
  Bench other{true, {}, [](exec::Blueprint& blueprint) {
                blueprint.add<Bell>("Bell", exec::Activity::periodic(10ms));
                blueprint.components.back().model = "Bell";
              }};
  EXPECT_EQ(other.run(kScript), "");
  EXPECT_GT(bench.lines.size(), 90u);
  EXPECT_EQ(bench.lines, other.lines);
}

TEST(EventsInRealTime, ReachTheScriptFromAnotherThread) {
  Bench bench{false, {}, [](exec::Blueprint& blueprint) {
                blueprint.add<Bell>("Bell", exec::Activity::periodic(10ms));
                blueprint.components.back().model = "Bell";
              }};
  EXPECT_EQ(bench.run("local n, m\n"
                      "on(Bell.Struck, function(count) m = count end)\n"
                      "_, n = wait(Bell.Struck)\n"
                      "wait(0.01) print(m == n)\n"
                      "stop()",
                      60s),
            "");
  EXPECT_THAT(bench.lines, ElementsAre("true"));
  EXPECT_EQ(bench.ended(), exec::RunEnd::kStopRequested);
}

struct Refusal {
  const char* script;
  const char* text;
};

class ListeningTo : public ::testing::TestWithParam<Refusal> {};

TEST_P(ListeningTo, WhatIsNoEventIsRefused) {
  Bench bench{true, {}, [](exec::Blueprint& blueprint) {
                blueprint.add<Bell>("Bell", exec::Activity::periodic(10ms));
                blueprint.components.back().model = "Bell";
              }};
  EXPECT_EQ(bench.run(GetParam().script),
            std::string("robot.lua:1: error: ") + GetParam().text + "\n");
}

INSTANTIATE_TEST_SUITE_P(
    Each, ListeningTo,
    ::testing::Values(
        Refusal{"on(Bell.struck, print)",
                "'Bell' has no property, port, operation or event 'struck' (did you mean "
                "'Struck'?)"},
        Refusal{"Bell.Struck = 5", "'Bell' has no property 'Struck'"},
        Refusal{"on()", "on takes an event and a function: on(Arming.Stop, function() ... end)"},
        Refusal{"on(Bell.Struck)",
                "on takes an event and a function: on(Arming.Stop, function() ... end)"},
        Refusal{"on(Bell.Struck, 5)",
                "on takes an event and a function: on(Arming.Stop, function() ... end)"},
        Refusal{"on(Bell.Struck, print, 5)",
                "on takes an event and a function: on(Arming.Stop, function() ... end)"},
        Refusal{"on(Axis, print)",
                "on takes an event and a function: on(Arming.Stop, function() ... end), found "
                "Axis"},
        Refusal{"on(nil, print)",
                "on takes an event and a function: on(Arming.Stop, function() ... end), found "
                "nothing"},
        Refusal{"wait(Bell.Struck, 'soon')",
                "wait(event, limit) takes a number of seconds, found soon"},
        Refusal{"wait(Bell.Struck, -1)",
                "wait(event, limit) takes a number of seconds, found -1"}));

}  // namespace
}  // namespace armature::lua::test
