// SPDX-License-Identifier: Apache-2.0
// What a script cannot do, whatever is in it.
#include <filesystem>
#include <fstream>

#include "armature/lua/internal/test_bench.hpp"

namespace armature::lua::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class Endless : public ::testing::TestWithParam<const char*> {};

TEST_P(Endless, ScriptIsEndedWithItsLine) {
  Bench bench;
  bench.time_limit = 50ms;
  EXPECT_THAT(
      bench.run(std::string("wait(1)\n") + GetParam()),
      ::testing::AllOf(StartsWith("robot.lua:2: error: "),
                       HasSubstr("the script has run for more than 0.05 s without a wait")));
  EXPECT_EQ(bench.application().now(), base::Time{} + 1s);
  EXPECT_EQ(bench.ended(), exec::RunEnd::kStopRequested);
}

INSTANTIATE_TEST_SUITE_P(
    Each, Endless,
    ::testing::Values("while true do end",
                      "while true do pcall(function() while true do end end) end",
                      "while true do local x <close> = setmetatable({}, {__close = function() "
                      "while true do end end}) end",
                      "repeat until Settings.Gain == 100",
                      "table.sort({1, 2, 3}, function() while true do end end)",
                      "local move = Axis:moveTo(0) while not move:done() do end",
                      "for k in pairs(setmetatable({1}, {})) do while true do end end"));

TEST(Limits, OfMemoryAreSaidWithTheLine) {
  Bench bench;
  bench.memory_limit = 4u << 20;
  EXPECT_EQ(bench.run("local all = {}\n"
                      "for i = 1, 1e9 do\n"
                      "  all[i] = ('x'):rep(1000) .. i\n"
                      "end"),
            "robot.lua:3: error: not enough memory\n");
  EXPECT_EQ(bench.run("local s = ('x'):rep(1 << 30)"), "robot.lua:1: error: not enough memory\n");
  EXPECT_EQ(bench.run("wait(1) print('another script runs')", 2s), "");
}

TEST(Limits, OfMemoryThatAreAbsurdAreSaidToo) {
  for (std::size_t bytes = 0; bytes < 60'000; bytes += 1'500) {
    Bench bench;
    bench.memory_limit = bytes;
    const std::string found = bench.run("stop()");
    if (found.empty()) continue;
    EXPECT_THAT(found, StartsWith("robot.lua")) << bytes;
    EXPECT_THAT(found, HasSubstr("enough memory")) << bytes;
  }
}

TEST(Limits, OfTheStackAreSaid) {
  Bench bench;
  bench.memory_limit = 1u << 30;
  EXPECT_THAT(bench.run("local function f() return 1 + f() end\nf()"),
              StartsWith("robot.lua:1: error: stack overflow"));
}

TEST(Limits, LeaveOutWhatLeadsOutOfTheSandbox) {
  for (const char* name : {"os", "io", "debug", "package", "load", "loadfile", "dofile",
                           "collectgarbage", "coroutine", "xpcall"}) {
    Bench bench;
    EXPECT_THAT(bench.run(std::string("return ") + name),
                StartsWith("robot.lua:1: error: unknown component or variable '" +
                           std::string(name) + "'"));
  }
  Bench bench;
  EXPECT_EQ(bench.run("print(string.dump) setmetatable({}, {__gc = print})"),
            "robot.lua:1: error: a metatable of a script has no __gc\n");
  EXPECT_EQ(bench.lines.at(0), "nil");
}

TEST(Limits, LetAScriptChangeNeitherComponentsNorTheirKind) {
  Bench bench;
  EXPECT_EQ(
      bench.run("print(pcall(setmetatable, _G, {}))\n"
                "print(getmetatable(Axis), getmetatable(Axis:moveTo(1)), getmetatable(left))\n"
                "left.x = 1"),
      "robot.lua:3: error: a composite has no variables: 'x'\n");
  EXPECT_THAT(bench.lines, ElementsAre("false\tcannot change a protected metatable",
                                       "component\tcommand\tfalse"));
}

TEST(Mistakes, OfSyntaxAreFoundBeforeAnythingRuns) {
  Bench bench;
  EXPECT_EQ(bench.run("print('begin')\nwait(1\nprint('end')"),
            "robot.lua:3: error: ')' expected (to close '(' at line 2) near 'print'\n");
  EXPECT_TRUE(bench.lines.empty());
  EXPECT_THAT(bench.run("\x1bLua"), HasSubstr("robot.lua: error: attempt to load a binary chunk"));
}

TEST(Mistakes, NameTheWholePathHoweverLongItIs) {
  Bench bench;
  bench.path = "/a/very/long/path/" + std::string(100, 'x') + "/to/" + std::string(80, 'y') +
               "/robot of a person.lua";
  EXPECT_EQ(bench.run("\nerror('here')"), bench.path + ":2: error: here\n");
  bench.path = "/scripts/" + std::string(90, 'z') + ".lua";
  EXPECT_EQ(bench.run("\nerror('here')"), bench.path + ":2: error: here\n");
}

TEST(Mistakes, InAPartAreShownOnceAndEndTheRun) {
  Bench bench;
  EXPECT_EQ(bench.run("at(1, function()\n  Axis:moveTo(-1)\nend)\n"
                      "at(1, function() Axis:moveTo(-2) end)\n"
                      "wait(5)"),
            "robot.lua:2: error: Axis.moveTo: the target is outside the axis\n");
  EXPECT_EQ(bench.application().now(), base::Time{} + 1s);
}

TEST(Mistakes, OfArithmeticNameTheVariable) {
  Bench bench;
  EXPECT_EQ(bench.run("local x\nprint(x + 1)"),
            "robot.lua:2: error: attempt to perform arithmetic on a nil value (local 'x')\n");
}

class Modules : public ::testing::Test {
 protected:
  Modules() {
    folder_ = std::filesystem::path(::testing::TempDir()) / "script_modules";
    std::filesystem::create_directories(folder_);
    bench.path = (folder_ / "robot.lua").string();
  }
  void write(const char* name, const char* text) { std::ofstream(folder_ / name) << text; }
  std::string place(const char* name) { return (folder_ / name).string(); }

  Bench bench;
  std::filesystem::path folder_;
};

TEST_F(Modules, LieBesideTheScriptAndAreLoadedOnce) {
  write("moves.lua",
        "print('loaded')\n"
        "local moves = {}\n"
        "function moves.go(x) return wait(Axis:moveTo(x)) end\n"
        "wait(0.1)\n"
        "return moves");
  EXPECT_EQ(bench.run("local moves = require('moves')\n"
                      "print(require('moves') == moves, moves.go(3))\n"
                      "stop()"),
            "");
  EXPECT_THAT(bench.lines, ElementsAre("loaded", "true\ttrue"));
}

TEST_F(Modules, WithMistakesAreNamed) {
  write("broken.lua", "\nlocal = 5");
  EXPECT_THAT(bench.run("require('broken')"), StartsWith(place("broken.lua") + ":2: error: "));
  write("wrong.lua", "\n\nAxis:moveTo(-1)");
  EXPECT_EQ(bench.run("require('wrong')"),
            place("wrong.lua") + ":3: error: Axis.moveTo: the target is outside the axis\n");
  write("itself.lua", "require('itself')");
  EXPECT_EQ(bench.run("require('itself')"),
            place("itself.lua") + ":1: error: 'itself' requires itself\n");
}

TEST_F(Modules, FromElsewhereAreRefused) {
  for (const char* name : {"'../secret'", "'/etc/passwd'", "'a.b'", "''", "5", "nil"}) {
    EXPECT_EQ(bench.run(std::string("require(") + name + ")"),
              place("robot.lua") +
                  ":1: error: require takes the name of a script beside this one, without .lua\n");
  }
  EXPECT_THAT(bench.run("require('nothing')"), HasSubstr("nothing.lua"));
}

TEST(Loading, AFileThatIsNotThereSaysSo) {
  base::Diagnostics diagnostics;
  load_script("/nowhere/robot.lua", {}, diagnostics);
  EXPECT_THAT(diagnostics.to_text(), HasSubstr("/nowhere/robot.lua"));
  EXPECT_EQ(diagnostics.error_count(), 1u);
}

}  // namespace
}  // namespace armature::lua::test
