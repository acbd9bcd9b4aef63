// SPDX-License-Identifier: Apache-2.0
// The experiment of paper 1 (table 2) on the simulated head: what the controllers reach, in
// simulated time, so that the figures are the same on every machine.
#include "tests/janus/experiment.hpp"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>

#include "armature/testing/realtime_guard.hpp"

namespace armature::janus {
namespace {

constexpr double kCount = 2.0 * 3.14159265358979 / kCountsPerTurn / 100.0;  ///< [rad] of the joint

Figures run(const std::string& file, const std::vector<std::string>& overrides = {}) {
  Robot robot(file, overrides);
  const Figures figures = run_experiment(robot);
  EXPECT_EQ(robot.application().faults(), 0u);
  EXPECT_EQ(robot.application().reactions(), 0u);
  EXPECT_EQ(robot.value<int>("Cards", "lost_answers"), 0);
  for (std::size_t i = 0; i < kJoints; ++i) {
    const auto& joint = figures.joints[i];
    std::printf(
        "%s: joint %zu: IAE %.5f ITAE %.4f ISE %.3g ITSE %.3g largest %.5f rad, at rest "
        "%.2f counts\n",
        file.c_str(), i + 1, joint.iae, joint.itae, joint.ise, joint.itse, joint.largest,
        figures.at_rest[i] / kCount);
  }
  return figures;
}

/// What a deployment with PIDs alone is to reach.
void expect_figures_of_paper(const std::string& file, const std::string& mode) {
  const Figures figures = run(file, {"mode=" + mode});
  for (std::size_t i = 0; i < kJoints; ++i) {
    EXPECT_LE(figures.joints[i].largest, 0.01) << mode << ", joint " << i + 1;
    EXPECT_LE(figures.joints[i].iae, 0.0213) << mode << ", joint " << i + 1;
    EXPECT_LE(figures.at_rest[i], 2.01 * kCount) << mode << ", joint " << i + 1;
  }
}

TEST(Experiment, PidsReachThePapersFiguresInBothModesOfTheBus) {
  expect_figures_of_paper("pid.yaml", "synchronous");
  expect_figures_of_paper("pid.yaml", "sequential");
}

TEST(Experiment, TheArrangementOfPaperTwoReachesTheSame) {
  expect_figures_of_paper("paper2.yaml", "sequential");
}

TEST(Experiment, FeedForwardTakesNineTenthsOfTheErrorAway) {
  const Figures pid = run("pid.yaml");
  const Figures both = run("pid_feed_forward.yaml");
  for (std::size_t i = 0; i < kJoints; ++i) {
    EXPECT_LE(both.joints[i].iae, 0.1 * pid.joints[i].iae) << "joint " << i + 1;
    EXPECT_LE(both.at_rest[i], 2.01 * kCount) << "joint " << i + 1;
  }
}

/// A description whose masses and inertias are those of the head times `factor`.
std::string write_description(double factor) {
  std::ifstream from(JANUS "/janus.urdf");
  const std::string text{std::istreambuf_iterator<char>(from), std::istreambuf_iterator<char>()};
  std::string scaled;
  std::size_t copied = 0;
  for (const char* attribute : {"mass value=\"", "ixx=\"", "iyy=\"", "izz=\""}) {
    EXPECT_NE(text.find(attribute), std::string::npos) << attribute;
  }
  while (true) {
    std::size_t begin = std::string::npos;
    for (const std::string attribute : {"mass value=\"", "ixx=\"", "iyy=\"", "izz=\""}) {
      const std::size_t found = text.find(attribute, copied);
      if (found != std::string::npos) begin = std::min(begin, found + attribute.size());
    }
    if (begin == std::string::npos) break;
    const std::size_t end = text.find('"', begin);
    scaled += text.substr(copied, begin - copied);
    scaled += std::to_string(factor * std::stod(text.substr(begin, end - begin)));
    copied = end;
  }
  scaled += text.substr(copied);
  const auto file =
      std::filesystem::path(::testing::TempDir()) / ("janus_" + std::to_string(factor) + ".urdf");
  std::ofstream(file) << scaled;
  return file;
}

TEST(Experiment, FeedForwardByAModelThatIsAFifthOffStillTakesTwoThirdsAway) {
  const Figures pid = run("pid.yaml");
  for (const double factor : {0.8, 1.2}) {
    const Figures both =
        run("pid_feed_forward.yaml",
            {"Model.robot_description=" + write_description(factor),
             "Controller.viscous_friction=[" + std::to_string(0.02 * factor) + "]",
             "Controller.coulomb_friction=[" + std::to_string(0.08 * factor) + "]"});
    for (std::size_t i = 0; i < kJoints; ++i) {
      EXPECT_LE(both.joints[i].iae, pid.joints[i].iae / 3.0) << factor << ", joint " << i + 1;
    }
  }
}

TEST(Experiment, NothingAllocatesWhileItRuns) {
  Robot robot("pid_feed_forward.yaml");
  robot.start_armed();
  ASSERT_EQ(robot.move_to({1.0, 1.0}, 2.0), "");
  const testing::RealtimeGuard guard;
  robot.run_for(std::chrono::seconds(4));
  EXPECT_EQ(guard.violations(), 0u) << guard.report();
}

}  // namespace
}  // namespace armature::janus
