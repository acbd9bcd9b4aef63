// SPDX-License-Identifier: Apache-2.0
// The browser of another process, to the letter.
#include "armature/browser/internal/test_away.hpp"

namespace armature::browser::test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(RemoteBrowser, ListsAndExplainsAsTheLocalOneDoes) {
  Desk desk;
  Away away;
  desk.type("run 0.1");
  away.pass(100ms);
  for (const char* line : {"ls",
                           "ls Settings",
                           "ls Axis left.hand.Finger",
                           "Axis",
                           "help Settings",
                           "help Axis",
                           "help Settings.Count",
                           "help Axis.Position",
                           "help Axis:arm",
                           "help moveTo",
                           "Axis.Both",
                           "Axis.Both[2]",
                           "Settings.Gains",
                           "Settings.Gains.kp",
                           "Settings.Label",
                           "Settings.Offsets",
                           "faults",
                           "help faults",
                           "ls \"aic-1\"",
                           "help Axxis",
                           "reset",
                           "start Axxis",
                           "threads 1",
                           "watch",
                           "watch Axis.Position every"}) {
    EXPECT_EQ(away.type(line), desk.type(line)) << line;
  }
}

TEST(RemoteBrowser, ItsPromptIsTheNameOfTheApplication) {
  EXPECT_EQ(Away().browser->prompt(), "application> ");
}

TEST(RemoteBrowser, SetsProperties) {
  Away away;
  EXPECT_EQ(away.type("Settings.Gain = 3"), "Settings.Gain = 3 V/rad");
  EXPECT_EQ(away.type("Settings.Gain = 1500 mV/rad"), "Settings.Gain = 1.5 V/rad");
  EXPECT_EQ(away.type("Settings.Loud=true"), "Settings.Loud = true");
  EXPECT_EQ(away.type("Settings.Label = 'right, or left'"), "Settings.Label = \"right, or left\"");
  EXPECT_EQ(away.type("Settings.Offsets = {1, -2.5}"), "Settings.Offsets = [1, -2.5] rad");
  EXPECT_EQ(away.type("Settings.Offsets = array(1)"), "Settings.Offsets = [1] rad");
  EXPECT_EQ(away.type("Settings.Limits = [4, 5, 6]"), "Settings.Limits = [4, 5, 6]");
  EXPECT_EQ(away.type("Settings.Gains = {kp = 2, steps = 3}"),
            "Settings.Gains = {kp: 2 V/rad, steps: 3}");
  EXPECT_EQ(away.type("aic-1.Count = 4"), "aic-1.Count = 4");
  EXPECT_EQ(away.browser->mistakes(), 0u);
}

TEST(RemoteBrowser, RefusesWhatCannotBeSet) {
  Away away;
  EXPECT_THAT(away.type("Settings.Count = 11"), HasSubstr("error: "));
  EXPECT_THAT(away.type("Settings.Fixed = 2"), HasSubstr("stop it first"));
  EXPECT_THAT(away.type("Settings.Gain = 3 m"), HasSubstr("error: Settings.Gain: "));
  EXPECT_EQ(away.type("Settings.Offsets = {1, 2"),
            "error: Settings.Offsets: expected '}', found the end of the line");
  EXPECT_EQ(away.type("Axis.Position = 1"),
            "error: 'Axis.Position' is a port: only components write it");
  EXPECT_EQ(away.browser->mistakes(), 5u);
}

TEST(RemoteBrowser, CallsOperations) {
  Away away;
  EXPECT_EQ(away.type("Settings:sum({1, 2.5}, 2)"), "7");
  EXPECT_EQ(away.type("Settings:twice([1])"), "[1, 1]");
  EXPECT_THAT(away.type("Settings:fail()"), HasSubstr("it broke"));
  EXPECT_THAT(away.type("Settings:sum(1)"),
              HasSubstr("Settings.sum takes 2 arguments, not 1: it is double("));
  EXPECT_EQ(away.type("Settings:Gain()"), "error: 'Settings.Gain' is not an operation");
  EXPECT_EQ(away.type("Settings:som()"), "error: 'Settings' has no 'som' (did you mean 'sum'?)");
}

TEST(RemoteBrowser, FollowsACommandToItsEnd) {
  Away away;
  EXPECT_EQ(away.type("Axis:moveTo(2)"), "Axis.moveTo: done");
  EXPECT_EQ(away.type("Axis:moveTo(500)"), "Axis.moveTo: under way; `wait` waits for its end");
  EXPECT_THAT(away.type("wait"), HasSubstr("Axis.moveTo: failed: the axis is stuck"));
  EXPECT_EQ(away.type("wait"), "");
  EXPECT_EQ(away.type("Axis:moveTo(-1)"), "error: Axis.moveTo: the target is outside the axis");
}

TEST(RemoteBrowser, TellsOfTheEndOfACommandWhileSomebodyTypes) {
  Away away;
  away.type("Axis:moveTo(12)");
  away.pass(1s);
  while (away.screen.lines.size() < 2) EXPECT_TRUE(away.browser->idle());
  EXPECT_EQ(away.screen.lines.back(), "Axis.moveTo: done");
}

TEST(RemoteBrowser, AnInterruptCancelsWhatIsWaitedFor) {
  Away away;
  away.screen.is_live = true;
  away.type("Axis:moveTo(12)");
  away.screen.asks_until_interrupt = 1;
  EXPECT_EQ(away.type("wait"), "Axis.moveTo: cancelled by its sender");
  EXPECT_THAT(away.screen.shown, Contains(HasSubstr("(Ctrl-C cancels)")));
  EXPECT_EQ(away.type("cancel"), "no command is under way");
}

TEST(RemoteBrowser, AnActOfTheOperatorIsNotForOtherProcesses) {
  Away away;
  EXPECT_THAT(away.type("Axis:arm()"), HasSubstr("'Axis.arm' is an act of the operator: another "));
}

TEST(RemoteBrowser, ChangesComponents) {
  Away away;
  EXPECT_EQ(away.type("stop Axis Settings"), "Axis: Stopped\nSettings: Stopped");
  EXPECT_EQ(away.type("faults"),
            "Axis      Stopped  \nSettings  Stopped  \n"
            "0 faults and 0 declared reactions since the start");
  EXPECT_EQ(away.type("start"), "Axis: Running\nSettings: Running");
  EXPECT_EQ(away.type("stop"),
            "error: stop takes the name of a component: stop Joint1; `quit` leaves");
  EXPECT_THAT(away.type("recover Axis"), HasSubstr("error: Axis: "));
  EXPECT_THAT(away.type("cleanup Axis"), HasSubstr("error: Axis: cannot be cleaned up"));
  EXPECT_EQ(away.type("stop Axis"), "Axis: Stopped");
  EXPECT_EQ(away.type("cleanup Axis"), "Axis: PreOperational");
  EXPECT_EQ(away.type("start"), "Axis: Running");
}

TEST(RemoteBrowser, WatchesValues) {
  Away away;
  EXPECT_EQ(away.type("watch Settings.Gain Settings.Count every 0.2 for 0.4"),
            "      time  Settings.Gain [V/rad]  Settings.Count\n"
            "   0.200 s                    2.5               3\n"
            "   0.400 s                    2.5               3");
}

TEST(RemoteBrowser, CompletesNames) {
  Away away;
  const auto words = [&](const char* line) { return away.browser->complete(line).words; };
  EXPECT_THAT(words("Set"), ElementsAre("Settings"));
  EXPECT_THAT(words("Axis:mo"), ElementsAre("Axis:moveTo("));
  EXPECT_THAT(words("Axis.P"), ElementsAre("Axis.Position"));
  EXPECT_THAT(words("aic-1.Ga"), ElementsAre("aic-1.Gain", "aic-1.Gains"));
  EXPECT_THAT(words("start le"), ElementsAre("left.hand.Finger"));
  EXPECT_THAT(words("thr"), ElementsAre("threads"));
  EXPECT_THAT(words("ru"), ElementsAre()) << "there is no Lua and no simulated time to command";
}

TEST(RemoteBrowser, WhatTheRobotSaysMovesNoCursor) {
  Away away;
  away.type("Settings.Label = 'a\x1b[2Jb\x07'");
  for (const char* line :
       {"Settings.Label", "ls Settings", "help Settings", "watch Settings.Label for 0.2"}) {
    const std::string said = away.type(line);
    EXPECT_THAT(said, HasSubstr("a?[2Jb?")) << line;
    EXPECT_THAT(said, Not(HasSubstr("\x1b"))) << line;
  }
}

TEST(RemoteBrowser, ExplainsWhatNamesNothing) {
  Away away;
  EXPECT_EQ(away.type("Setings"),
            "error: unknown command or component 'Setings' (did you mean 'Settings'?)");
  EXPECT_EQ(away.type("thraeds"),
            "error: unknown command or component 'thraeds' (did you mean 'threads'?)");
  EXPECT_EQ(away.type("run 5"), "error: unknown command or component 'run 5'");
  EXPECT_EQ(away.type("Settings.Gian"), "error: 'Settings' has no 'Gian' (did you mean 'Gain'?)");
  EXPECT_EQ(away.type("Settings.Gain[3]"), "error: 'Settings.Gain' is a double and has no '[3]'");
  EXPECT_EQ(away.type("Settings.Offsets[3]"),
            "error: 'Settings.Offsets[3]' is not there: it is [0.5, -1]");
  EXPECT_EQ(away.browser->mistakes(), 6u);
}

TEST(RemoteBrowser, TellsTheAgeOfAValueThatIsOlderThanASecond) {
  Desk desk;
  Away away;
  desk.type("run 0.1\nstop Axis\nrun 2");
  away.pass(100ms);
  away.type("stop Axis");
  away.pass(2s);
  EXPECT_THAT(away.type("Axis.Position"), ::testing::MatchesRegex("0 m, 2[.0-9]* s old"));
  EXPECT_EQ(desk.type("Axis.Position"), "0 m") << "who types there sees it stop";
}

TEST(RemoteBrowser, AnInterruptEndsAWait) {
  Away away;
  away.screen.asks_until_interrupt = 3;
  EXPECT_EQ(away.type("wait 900"), "interrupted");
  EXPECT_EQ(away.type("wait -1"), "error: wait takes the seconds to wait, above 0: wait 5");
}

TEST(RemoteBrowser, QuitLeavesAndTheApplicationGoesOn) {
  Away away;
  away.type("Axis:moveTo(1000)");
  EXPECT_EQ(away.type("quit"),
            "Axis.moveTo: cancelled, because the connection of the client that began it has ended");
  EXPECT_TRUE(away.browser->has_ended());
  away.screen.lines.clear();
  away.browser->stop();
  EXPECT_THAT(away.screen.lines, ::testing::IsEmpty()) << "what is said once is not said again";
  EXPECT_TRUE(away.bench.application().running());
}

TEST(RemoteBrowser, KnowsEveryCommandOfItsHelp) {
  Away away;
  const std::string overview = away.type("help");
  for (const internal::Topic& topic : internal::plain_vocabulary().commands) {
    EXPECT_THAT(overview, HasSubstr(std::string(topic.usage)));
    EXPECT_THAT(away.type("help " + std::string(topic.name)), Not(HasSubstr("error: ")));
    EXPECT_THAT(away.type(std::string(topic.name) + " ]"), Not(HasSubstr("no command")));
  }
}

}  // namespace
}  // namespace armature::browser::test
