// SPDX-License-Identifier: Apache-2.0
// The experiment of paper 1 (table 2) as its script commands it.
#include "armature/lua/script.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/janus/experiment.hpp"

namespace armature::janus {
namespace {

using namespace std::chrono_literals;

/// Looks at both joints in every period, beside the experiment.
constexpr const char* kWatch = R"(at(0, function()
  wait(0.5)   -- until it is armed
  while true do
    wait(0.01)
    print(string.format("watch %.17g %.17g %.17g %.17g", PID1.Ref, PID1.Sen, PID2.Ref, PID2.Sen))
  end
end)
)";

/// What a run of the experiment's script printed of itself, and where the joints were.
struct Course {
  std::vector<std::string> lines;
  std::vector<std::array<double, 4>> samples;  ///< desired, measured of joint 1, of joint 2 [rad]
};

Course run_experiment_script() {
  Course course;
  lua::Options options;
  options.print = [&](std::string_view line) {
    std::array<double, 4> sample{};
    const std::string text(line);
    if (std::sscanf(text.c_str(), "watch %lf %lf %lf %lf", &sample[0], &sample[1], &sample[2],
                    &sample[3]) == 4) {
      course.samples.push_back(sample);
    } else {
      course.lines.push_back(text);
    }
  };
  std::ifstream file(JANUS "/experiment.lua");
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  base::Diagnostics diagnostics;
  const auto script =
      lua::parse_script(kWatch + text, JANUS "/experiment.lua", options, diagnostics);
  Robot robot("pid.yaml");
  robot.start();
  EXPECT_EQ(script->run(robot.application(), 100s, nullptr, diagnostics),
            exec::RunEnd::kStopRequested);
  EXPECT_EQ(diagnostics.to_text(), "");
  EXPECT_LT(robot.application().now(), base::Time{} + 61s) << "it says stop()";
  EXPECT_EQ(robot.application().faults(), 0u);
  EXPECT_EQ(robot.application().reactions(), 0u);
  return course;
}

TEST(Script, CommandsTheExperimentAndBothJointsFollow) {
  const Course course = run_experiment_script();
  ASSERT_GT(course.samples.size(), 5900u);
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
    double largest = 0.0;
    double farthest = 0.0;
    for (const auto& sample : course.samples) {
      largest = std::max(largest, std::abs(sample[2 * joint] - sample[2 * joint + 1]));
      farthest = std::max(farthest, sample[2 * joint + 1]);
    }
    EXPECT_LE(largest, 0.01) << "joint " << joint + 1;
    EXPECT_NEAR(farthest, 4.0, 0.01) << "joint " << joint + 1;
    EXPECT_NEAR(course.samples.back()[2 * joint + 1], 0.0, 1e-3) << "joint " << joint + 1;
  }
}

TEST(Script, RunsTheExperimentTwiceTheSameToTheBit) {
  const Course first = run_experiment_script();
  const Course second = run_experiment_script();
  EXPECT_EQ(first.lines, second.lines);
  EXPECT_EQ(first.samples, second.samples);
}

/// What the script of the patrol printed; the robot is looked at where it ended.
std::vector<std::string> run_patrol() {
  std::vector<std::string> lines;
  lua::Options options;
  options.print = [&](std::string_view line) { lines.emplace_back(line); };
  base::Diagnostics diagnostics;
  const auto script = lua::load_script(JANUS "/patrol.lua", options, diagnostics);
  Robot robot("pid.yaml");
  robot.start();
  EXPECT_EQ(script->run(robot.application(), 100s, nullptr, diagnostics),
            exec::RunEnd::kStopRequested);
  EXPECT_EQ(diagnostics.to_text(), "");
  EXPECT_EQ(robot.application().faults(), 0u);
  EXPECT_EQ(robot.application().reactions(), 0u);
  return lines;
}

std::size_t count_of(const std::vector<std::string>& lines, const std::string& text) {
  return static_cast<std::size_t>(std::count_if(lines.begin(), lines.end(), [&](const auto& line) {
    return line.find(text) != std::string::npos;
  }));
}

TEST(Script, PatrolsByAStateMachineThatPausesAndRecovers) {
  const std::vector<std::string> lines = run_patrol();
  std::string all;
  for (const std::string& line : lines) all += line + "\n";
  EXPECT_GE(count_of(lines, "looks at place 1, joints at 1.00 and 0.50"), 3u) << all;
  EXPECT_GE(count_of(lines, "looks at place 2, joints at 3.00 and 1.00"), 2u) << all;
  EXPECT_EQ(count_of(lines, "looks at place 3"), 0u) << all;
  EXPECT_EQ(count_of(lines, "leaves out place 3: "), 1u) << all;
  EXPECT_EQ(count_of(lines, "pauses"), 1u) << all;
  EXPECT_EQ(count_of(lines, "goes on"), 1u) << all;
  ASSERT_FALSE(lines.empty());
  EXPECT_NE(lines.back().find("is off"), std::string::npos) << all;
}

TEST(Script, PatrolsTwiceTheSame) { EXPECT_EQ(run_patrol(), run_patrol()); }

/// The block of Lua in the documentation that has `text`.
std::string documented_script(const std::string& text) {
  std::ifstream file(JANUS "/../../docs/scripts.md");
  const std::string page{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const std::string fence = "```";
  const std::size_t at = page.find(text);
  if (at == std::string::npos) return {};
  const std::size_t begin = page.rfind(fence + "lua\n", at) + fence.size() + 4;
  return page.substr(begin, page.find(fence, at) - begin);
}

TEST(Script, OfTheDocumentationRuns) {
  std::vector<std::string> lines;
  lua::Options options;
  options.print = [&](std::string_view line) { lines.emplace_back(line); };
  base::Diagnostics diagnostics;
  const auto script = lua::parse_script(documented_script("local shuttle = machine {"),
                                        "shuttle.lua", options, diagnostics);
  Robot robot("pid.yaml");
  robot.start();
  EXPECT_EQ(script->run(robot.application(), 100s, nullptr, diagnostics),
            exec::RunEnd::kStopRequested);
  EXPECT_EQ(diagnostics.to_text(), "");
  EXPECT_EQ(lines, std::vector<std::string>{"rests at 10.0"});
  EXPECT_GT(robot.application().now(), base::Time{} + 23s);
  EXPECT_LT(robot.application().now(), base::Time{} + 25s);
}

TEST(Script, SaysASignAsABooleanAndQueuesMotions) {
  std::vector<std::string> lines;
  lua::Options options;
  options.print = [&](std::string_view line) { lines.emplace_back(line); };
  base::Diagnostics diagnostics;
  const auto script = lua::parse_script(R"(
local _, why = pcall(function() Joint1.SensorSign = true end)
print(why:match("cannot change while the component runs"))
wait(0.1)
assert(wait(Arming:arm()))
local first = Generator:moveTo(array(0.2, 0.2), 1)
local second = Generator:moveTo(array(0.0, 0.0), 1)
print(second:done(), second:progress(), tostring(second):match("waiting"))
assert(wait(second))
print(first:done(), math.abs(Joint1.Position) < 0.01)
first = Generator:moveTo(array(0.2, 0.2), 1)
second = Generator:moveTo(array(0.0, 0.0), 1)
wait(0.2)
Arming:disarm()
print(wait(second))
stop()
)",
                                        "test.lua", options, diagnostics);
  Robot robot("pid.yaml");
  robot.start();
  EXPECT_EQ(script->run(robot.application(), 100s, nullptr, diagnostics),
            exec::RunEnd::kStopRequested);
  EXPECT_EQ(diagnostics.to_text(), "");
  const std::vector<std::string> expected = {
      "cannot change while the component runs", "false\t0.0\twaiting", "true\ttrue",
      "false\tit waited for a command that was not done: the robot was disarmed or armed"};
  EXPECT_EQ(lines, expected);
}

}  // namespace
}  // namespace armature::janus
