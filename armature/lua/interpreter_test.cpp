// SPDX-License-Identifier: Apache-2.0
// Lua as it is typed, and what whoever types is told.
#include "armature/lua/interpreter.hpp"

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/lua/names.hpp"
#include "armature/testing/small_robot.hpp"

namespace armature::lua::test {
namespace {

using namespace testing::small_robot;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Notes what it is told; types Ctrl-C at the so-many-th time that it is asked.
class Notes final : public Listener {
 public:
  void say(std::string_view line) override { lines.emplace_back(line); }
  void complain(std::string_view text) override { lines.emplace_back(text); }
  void tell(const BegunCommand& command) override { commands.push_back(command); }
  void show_progress(const std::vector<BegunCommand>& now) override {
    if (!now.empty()) shown.push_back(now.front().progress);
  }
  void end_progress() override { ++progress_ends; }
  bool interrupted() const override {
    if (asks_until_interrupt > 0 && --asks_until_interrupt == 0) interrupt = true;
    return interrupt;
  }
  bool take_interrupt() override { return std::exchange(interrupt, false); }

  std::vector<std::string> lines;
  std::vector<BegunCommand> commands;
  std::vector<double> shown;
  int progress_ends = 0;
  mutable int asks_until_interrupt = 0;
  mutable bool interrupt = false;
};

struct Typist {
  SmallRobot robot;
  Course course{robot.application(), 1000s, nullptr};
  Notes notes;
  std::unique_ptr<Interpreter> lua =
      make_interpreter(robot.application(), course, notes, {.simulated = true, .most_elements = 3});
};

TEST(Interpreter, SaysWhatIsPrintedAndWhatAnExpressionGives) {
  Typist typist;
  EXPECT_TRUE(typist.lua->run("print('printed')"));
  EXPECT_TRUE(typist.lua->run("Settings.Gain * 2"));
  EXPECT_TRUE(typist.lua->run("{1, 2, 3, 4, 5}"));
  EXPECT_THAT(typist.notes.lines, ElementsAre("printed", "5.0", "[1, 2, 3, ... 5 elements]"));
}

TEST(Interpreter, ComplainsOfAMistakeAndGoesOn) {
  Typist typist;
  EXPECT_FALSE(typist.lua->run("Axsi.Position"));
  EXPECT_THAT(typist.notes.lines, ElementsAre(HasSubstr("error: unknown component")));
  EXPECT_TRUE(typist.lua->run("1"));
}

TEST(Interpreter, KnowsWhatIsNotWhole) {
  Typist typist;
  EXPECT_TRUE(typist.lua->is_incomplete("if true then"));
  EXPECT_FALSE(typist.lua->is_incomplete("if true then end"));
  EXPECT_FALSE(typist.lua->is_incomplete("foo bar"));
}

TEST(Interpreter, TellsOfACommandUntilItsEnd) {
  Typist typist;
  typist.lua->run("Axis:moveTo(3)");
  typist.lua->wait_for_commands();
  ASSERT_EQ(typist.notes.commands.size(), 2u);
  EXPECT_EQ(typist.notes.commands[0].name, "Axis.moveTo");
  EXPECT_FALSE(typist.notes.commands[0].ended);
  EXPECT_TRUE(typist.notes.commands[1].ended);
  EXPECT_EQ(typist.notes.commands[1].stage, component::CommandStage::kDone);
  EXPECT_EQ(typist.notes.commands[1].reason, "");
  EXPECT_FALSE(typist.notes.shown.empty());
  EXPECT_GT(typist.notes.progress_ends, 0);
}

TEST(Interpreter, AnInterruptCancelsTheCommandsThatAreWaitedFor) {
  Typist typist;
  typist.lua->run("Axis:moveTo(999)");
  typist.notes.asks_until_interrupt = 10;
  typist.lua->wait_for_commands();
  EXPECT_EQ(typist.notes.commands.back().stage, component::CommandStage::kCancelled);
  EXPECT_FALSE(typist.lua->cancel_commands()) << "none is under way";
}

TEST(Interpreter, ListsMachinesAndNames) {
  Typist typist;
  typist.lua->run("velocity = 3");
  typist.lua->run("m = machine {name = 'Work', initial = 'Idle', Idle = {}}");
  ASSERT_EQ(typist.lua->machines().size(), 1u);
  EXPECT_EQ(typist.lua->machines()[0].name, "Work");
  EXPECT_EQ(typist.lua->machines()[0].state, "");
  typist.lua->run("m:start()");
  typist.lua->let_pass(100ms, {});
  EXPECT_EQ(typist.lua->machines()[0].state, "Idle");
  EXPECT_THAT(typist.lua->names_in(""), Contains("velocity"));
  EXPECT_THAT(typist.lua->names_in("math"), Contains("floor"));
  EXPECT_TRUE(typist.lua->names_in("nothing").empty());
}

TEST(Interpreter, StopEndsTheCourse) {
  Typist typist;
  typist.lua->run("stop()");
  EXPECT_FALSE(typist.lua->catch_up());
  EXPECT_EQ(typist.course.end(), exec::RunEnd::kStopRequested);
}

TEST(Names, AreSpelledAsLuaHasThemAndBack) {
  EXPECT_EQ(in_lua("Joint1"), "Joint1");
  EXPECT_EQ(in_lua("left.Finger"), "left.Finger");
  EXPECT_EQ(in_lua("aic-1"), "_G[\"aic-1\"]");
  EXPECT_EQ(in_lua("left.end"), "left[\"end\"]");
  EXPECT_EQ(without_lua("_G[\"aic-1\"].Gain"), "aic-1.Gain");
  EXPECT_EQ(without_lua("\"aic-1\""), "aic-1");
  EXPECT_EQ(without_lua("Joint1.Gain"), "Joint1.Gain");
}

}  // namespace
}  // namespace armature::lua::test
