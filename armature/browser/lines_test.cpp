// SPDX-License-Identifier: Apache-2.0
// What lines that the operator types do and say.
#include "armature/browser/internal/test_screen.hpp"

namespace armature::browser::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

struct Line {
  const char* typed;
  const char* says;
};

class Typing : public ::testing::TestWithParam<Line> {};

TEST_P(Typing, GivesItsAnswer) {
  Desk desk;
  EXPECT_EQ(desk.type(GetParam().typed), GetParam().says);
  EXPECT_EQ(desk.browser.mistakes(), 0u);
}

INSTANTIATE_TEST_SUITE_P(
    Each, Typing,
    ::testing::Values(
        Line{"", ""}, Line{"  -- only a remark", ""}, Line{"Settings.Gain", "2.5 V/rad"},
        Line{"Settings.Count", "3"}, Line{"Settings.Loud", "false"},
        Line{"Settings.Label", "\"left\""}, Line{"Settings.Offsets", "[0.5, -1] rad"},
        Line{"Settings.Offsets[2]", "-1 rad"}, Line{"Settings.Limits[3]", "3"},
        Line{"Settings.Gains", "{kp: 0 V/rad, steps: 1}"}, Line{"Settings.Gains.kp", "0 V/rad"},
        Line{"left.hand.Finger.Gain", "2.5 V/rad"}, Line{"aic-1.Gain", "2.5 V/rad"},
        Line{"_G[\"aic-1\"].Gain", "2.5 V/rad"}, Line{"Axis.Position", "not yet written"},
        Line{"run 0.01\nAxis.Position", "0 m"}, Line{"Settings.Gain * 2", "5.0"},
        Line{"1, 'two', {3}", "1\ntwo\n[3]"}, Line{"Settings:sum({1, 2}, 10)", "30.0"},
        Line{"print(now())", "0.0"}, Line{"local x = 4\nx + 1", "5"}, Line{"run = 5\nrun + 1", "6"},
        Line{"for i = 1, 2 do\nprint(i)\nend", "1\n2"}, Line{"print('a=b')", "a=b"},
        Line{"wait(0.5)\nnow()", "0.5"}, Line{"wait 0.5\nnow()", "0.5"},
        Line{"run 250 ms\nnow()", "0.25"},
        Line{"at(0.2, function() print('later') end)\nrun 1", "later"},
        Line{"Settings.Gain = 4", "Settings.Gain = 4 V/rad"},
        Line{"Settings.Gain = 2 mV/rad", "Settings.Gain = 0.002 V/rad"},
        Line{"aic-1.Gain = 4", "aic-1.Gain = 4 V/rad"},
        Line{"Settings.Offsets = {1, 2, 3}", "Settings.Offsets = [1, 2, 3] rad"},
        Line{"Settings.Label = 'a\\27b'", "Settings.Label = \"a\\27b\""},
        Line{"Settings.Gains = {kp = 2, steps = 3}", "Settings.Gains = {kp: 2 V/rad, steps: 3}"},
        Line{"Axis:arm()\nwait", "Axis.arm: done"},
        Line{"m = Axis:moveTo(3)\nwait(m)\nm:done()", "Axis.moveTo: done\ntrue\ntrue"},
        Line{"m = Axis:moveTo(20)\nwait", "Axis.moveTo: failed: the axis is stuck"},
        Line{"m = Axis:moveTo(20)\ncancel\nrun 0.1", "Axis.moveTo: cancelled by its sender"},
        Line{"m = Axis:moveTo(3)\nrun 1\nm", "Axis.moveTo: done\nAxis.moveTo: done"},
        Line{"cancel", "no command is under way"}, Line{"pace", "as fast as possible"},
        Line{"pace 0.5\npace pause\npace step\npace go\npace most",
             "0.5 s in a second\npaused\npaused\n0.5 s in a second\nas fast as possible"},
        Line{"stop Settings\nSettings.Fixed = 2\nstart Settings",
             "Settings: Stopped\nSettings.Fixed = 2\nSettings: Running"},
        Line{"stop Settings, Axis\nstart",
             "Settings: Stopped\nAxis: Stopped\n"
             "Axis: Running\nSettings: Running"},
        Line{"start", "no component is stopped"}, Line{"reset", "no component is in an exception"},
        Line{"recover", "no component is in a run-time error"},
        Line{"faults", "all components run; 0 faults and 0 declared reactions since the start"}));

class Mistyping : public ::testing::TestWithParam<Line> {};

TEST_P(Mistyping, IsToldAndTheBrowserGoesOn) {
  Desk desk;
  EXPECT_EQ(desk.type(GetParam().typed), std::string("error: ") + GetParam().says);
  EXPECT_EQ(desk.browser.mistakes(), 1u);
  EXPECT_EQ(desk.type("1 + 1"), "2");
  EXPECT_FALSE(desk.browser.has_ended());
}

INSTANTIATE_TEST_SUITE_P(
    Each, Mistyping,
    ::testing::Values(
        Line{"pace fast",
             "pace takes simulated seconds in a second, or most, pause, step or go: pace 0.1"},
        Line{"pace 0", "the pace is a number above 0: 1 is real time, 0.1 a tenth of it"},
        Line{"pace step", "only paused simulated time goes on by steps"},
        Line{"Axsi.Position", "unknown component or variable 'Axsi' (did you mean 'Axis'?)"},
        Line{"Axis.Positoin",
             "'Axis' has no property, port, operation or event 'Positoin' (did you mean "
             "'Position'?)"},
        Line{"Settings.Gain = 'much'", "Settings.Gain must be a number, found the text 'much'"},
        Line{"Settings.Count = 11", "property 'Count' of 'Settings' is 11, outside 0 .. 10"},
        Line{"Settings.Fixed = 2",
             "property 'Fixed' of 'Settings' cannot change while the "
             "component runs; stop it first"},
        Line{"Settings.Gain = 3 m",
             "Settings.Gain: cannot convert 'm' to 'V/rad': the first is m, the second "
             "m^2 kg s^-3 A^-1 rad^-1"},
        Line{"Settings.Offsets[1] = 2",
             "'Settings.Offsets[1]' is a part of what was read: set the "
             "whole, Settings.Offsets = ..."},
        Line{"Settings.Offsets[3]", "'Settings.Offsets[3]' is not there: it is [0.5, -1]"},
        Line{"Axis.Position = 2", "'Axis.Position' is a port: only components write it"},
        Line{"Axis:moveTo(-1)", "Axis.moveTo: the target is outside the axis"},
        Line{"Settings:fail()", "Settings.fail: fail: failed: exception: it broke"},
        Line{"for i = 1, 2 do\nerror('no')\nend", "no (in line 2)"},
        Line{"foo bar", "syntax error near 'bar'"},
        Line{"start Axsi", "unknown component 'Axsi' (did you mean 'Axis'?)"},
        Line{"ls Axsi", "unknown component 'Axsi' (did you mean 'Axis'?)"},
        Line{"stop",
             "stop takes the name of a component: stop Joint1; `quit` stops the "
             "application"},
        Line{"run", "run takes the seconds to let pass, above 0: run 5"},
        Line{"run -1", "run takes the seconds to let pass, above 0: run 5"},
        Line{"watch", "watch takes the items to show: watch Joint1.Position every 0.2"},
        Line{"watch Axis.Position every",
             "every takes seconds above 0, for example 0.2, found nothing"},
        Line{"watch Axis:moveTo", "'Axis:moveTo' has no value"},
        Line{"threads 3", "threads takes no arguments, found '3'"},
        Line{"help Axsi", "no help on 'Axsi' (did you mean 'Axis'?)"},
        Line{"help Axis.Positoin", "'Axis' has no 'Positoin' (did you mean 'Position'?)"}));

TEST(BrowserLines, ComeFromTheOperatorWhoMayArm) {
  Desk desk;
  EXPECT_EQ(desk.type("assert(wait(Axis:arm()))"), "true\nAxis.arm: done");
}

TEST(BrowserLines, OfAStatementThatIsNotWholeAskForMore) {
  Desk desk;
  EXPECT_EQ(desk.type("if true then"), "");
  EXPECT_TRUE(desk.browser.wants_more());
  EXPECT_EQ(desk.browser.prompt(), "... ");
  EXPECT_EQ(desk.type("print('whole') end"), "whole");
  EXPECT_FALSE(desk.browser.wants_more());
  EXPECT_EQ(desk.type("if true then"), "");
  desk.browser.forget_lines();
  EXPECT_EQ(desk.type("1"), "1");
}

TEST(BrowserLines, ShortenLongLists) {
  Desk desk;
  desk.type("x = {}\nfor i = 1, 1000 do x[i] = i / 2 end\nSettings.Offsets = x");
  EXPECT_THAT(desk.type("Settings.Offsets"), HasSubstr(" 49.5, 50, ... 1000 elements] rad"));
  EXPECT_THAT(desk.type("x"), HasSubstr("50.0, ... 1000 elements]"));
  EXPECT_THAT(desk.type("ls Settings"), HasSubstr("[0.5, 1, 1.5, 2, 2.5, 3, 3.5, 4, ... 1000"));
}

TEST(BrowserLines, ShowAllElementsOfAValueThatWasAskedFor) {
  Desk desk;
  const std::string all = "[1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14] rad";
  EXPECT_EQ(desk.type("Settings.Offsets = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14}"),
            "Settings.Offsets = " + all);
  EXPECT_EQ(desk.type("Settings.Offsets"), all);
  EXPECT_EQ(desk.type("print(Settings.Offsets)"),
            "[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0, 12.0, 13.0, 14.0]");
}

TEST(BrowserLines, LetSimulatedTimePassOnlyAsTold) {
  Desk desk;
  EXPECT_EQ(desk.browser.prompt(), "application 0 s> ");
  desk.type("1 + 1\nls\nAxis:moveTo(3)");
  EXPECT_EQ(desk.browser.prompt(), "application 0 s> ");
  desk.type("run 0.5");
  EXPECT_EQ(desk.browser.prompt(), "application 0.5 s> ");
}

TEST(BrowserLines, EndTheApplicationByQuitAndByStop) {
  for (const char* line : {"quit", "exit", "stop()"}) {
    Desk desk;
    desk.type(line);
    EXPECT_TRUE(desk.browser.has_ended()) << line;
    EXPECT_EQ(desk.local.session.end(), exec::RunEnd::kStopRequested);
  }
}

TEST(BrowserLines, EndWhenTheTimeOfTheRunIsUp) {
  Desk desk;
  desk.type("wait(2000)");
  EXPECT_TRUE(desk.browser.has_ended());
  EXPECT_EQ(desk.local.session.end(), exec::RunEnd::kTimeUp);
}

TEST(BrowserLines, ThatRunForLongAreInterrupted) {
  Desk desk;
  desk.screen.asks_until_interrupt = 50;
  EXPECT_EQ(desk.type("while true do pcall(error) end"), "interrupted");
  EXPECT_EQ(desk.type("1"), "1");
  desk.screen.asks_until_interrupt = 50;
  EXPECT_EQ(desk.type("wait(900)"), "interrupted");
  desk.screen.asks_until_interrupt = 50;
  EXPECT_THAT(desk.type("run 900"), HasSubstr("interrupted at "));
  EXPECT_FALSE(desk.browser.has_ended());
}

TEST(BrowserLines, ThatWaitForACommandCancelItAtTheFirstInterrupt) {
  for (const char* wait : {"wait", "wait(move)"}) {
    Desk desk;
    desk.screen.asks_until_interrupt = 10;
    EXPECT_THAT(desk.type(std::string("move = Axis:moveTo(999)\n") + wait),
                HasSubstr("Axis.moveTo: cancelled by its sender"));
    EXPECT_LT(desk.bench.application().now(), base::Time{} + 5s);
    EXPECT_EQ(desk.type("move:done()"), "true");
  }
}

TEST(BrowserLines, ShowTheProgressOfCommandsWhereSomebodyLooks) {
  Desk desk;
  desk.screen.is_live = true;
  desk.type("move = Axis:moveTo(3)\nwait");
  ASSERT_FALSE(desk.screen.shown.empty());
  EXPECT_THAT(desk.screen.shown.front(), HasSubstr("Axis.moveTo"));
  EXPECT_THAT(desk.screen.shown.front(), HasSubstr("(Ctrl-C cancels)"));
}

TEST(BrowserLines, OfAtThatAreMistakesEndOnlyTheirPart) {
  Desk desk;
  EXPECT_EQ(desk.type("at(0.1, function() error('broken', 0) end)\n"
                      "at(0.2, function() print('next') end)\nrun 1"),
            "error: broken\nnext");
  EXPECT_FALSE(desk.browser.has_ended());
}

TEST(BrowserLines, ReachRunningThreadsInRealTime) {
  Desk desk(false);
  EXPECT_EQ(desk.type("Settings.Gain = 4"), "Settings.Gain = 4 V/rad");
  EXPECT_THAT(desk.type("move = Axis:moveTo(3)\nwait\nAxis.Position"),
              HasSubstr("Axis.moveTo: done"));
  EXPECT_EQ(desk.type("Axis.Position"), "3 m");
}

}  // namespace
}  // namespace armature::browser::test
