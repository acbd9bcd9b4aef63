// SPDX-License-Identifier: Apache-2.0
// The experiment of paper 1 (table 2) as its script commands it.
#include "armature/script/script.hpp"

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
  script::Options options;
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
  script::Script script =
      script::parse_script(kWatch + text, JANUS "/experiment.lua", options, diagnostics);
  Robot robot("pid.yaml");
  robot.start();
  EXPECT_EQ(script.run(robot.application(), 100s, nullptr, diagnostics),
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

}  // namespace
}  // namespace armature::janus
