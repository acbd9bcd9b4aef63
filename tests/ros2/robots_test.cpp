// SPDX-License-Identifier: Apache-2.0
// Robots of the example that a program with Fast DDS commands, and that comes to its end: in
// simulated time, which goes as fast as a clock on the wall.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "armature/platform/child_process.hpp"
#include "armature/testing/deployed_robot.hpp"

namespace armature::ros2 {
namespace {

using namespace std::chrono_literals;
using component::CommandStage;

constexpr int kDomain = 62;

deploy::Deployment example(const std::string& file) {
  deploy::DeploymentOptions options;
  options.library_folders = {LIBRARIES};
  options.document.overrides = {"domain=" + std::to_string(kDomain)};
  return deploy::load_deployment(EXAMPLES "/13_ros2/" + file, options);
}

/// Lets the robot's time go as fast as that of the program that commands it.
void run_beside(testing::DeployedRobot& robot, base::Duration duration) {
  const auto begin = std::chrono::steady_clock::now();
  for (base::Duration passed{}; passed < duration; passed += 10ms) {
    robot.run_for(10ms);
    std::this_thread::sleep_until(begin + passed);
  }
}

platform::ChildProcess commander(std::vector<std::string> words) {
  words.insert(words.begin(), {COMMANDER, std::to_string(kDomain)});
  return std::move(platform::ChildProcess::start(words)).value();
}

/// Until `reached`, for 10 s at most.
template <typename Reached>
bool runs_until(testing::DeployedRobot& robot, const Reached& reached) {
  for (int k = 0; k < 100 && !reached(); ++k) run_beside(robot, 100ms);
  return reached();
}

/// The first joint [rad].
double measured(testing::DeployedRobot& robot) {
  return robot.value<std::vector<double>>("BridgeRef", "nAxesSensorPosition")[0];
}
bool moves(testing::DeployedRobot& robot) { return robot.value<bool>("JointTrajectory", "Moves"); }
std::uint64_t refused(testing::DeployedRobot& robot) {
  return robot.value<std::uint64_t>("JointTrajectory", "Refused");
}

/// @param way  from the present position of the first joint [rad], of a trajectory of 4 s
void moves_and_stops_smoothly(testing::DeployedRobot& robot, const std::string& joints,
                              double target, double max_velocity, double max_acceleration) {
  auto program = commander({"joint_trajectory", joints, std::to_string(target), "4"});
  // It is not armed: nothing moves, however long the commander goes on, also when the operator arms
  // it meanwhile.
  ASSERT_TRUE(runs_until(robot, [&] { return refused(robot) > 5; })) << robot.reasons();
  ASSERT_EQ(robot.arm(), CommandStage::kDone) << robot.reasons();
  const double begin = measured(robot);
  run_beside(robot, 500ms);
  EXPECT_FALSE(moves(robot));
  EXPECT_NEAR(measured(robot), begin, 0.02);
  program.send(SIGKILL);

  // Once it was silent, it is obeyed.
  run_beside(robot, 800ms);
  auto second = commander({"joint_trajectory", joints, std::to_string(target), "4"});
  ASSERT_TRUE(runs_until(robot, [&] { return moves(robot); })) << robot.reasons();
  const double way = target - begin;
  ASSERT_TRUE(runs_until(robot, [&] {
    return std::abs(measured(robot) - begin) > 0.4 * std::abs(way);
  })) << robot.reasons();
  second.send(SIGKILL);

  // From the last message on it goes on for 0.5 s, then brakes on its way, within its limits.
  std::vector<double> positions;
  for (int k = 0; k < 300; ++k) {
    run_beside(robot, 10ms);
    positions.push_back(robot.value<std::vector<double>>("Generator", "nAxesDesiredPosition")[0]);
  }
  EXPECT_FALSE(moves(robot));
  EXPECT_EQ(positions.back(), positions[positions.size() - 50]) << "it has not come to rest";
  EXPECT_LT(std::abs(positions.back() - begin), 0.95 * std::abs(way)) << "it went on to the end";
  EXPECT_NEAR(measured(robot), positions.back(), 0.02)
      << "the joint does not hold where it stopped";
  for (std::size_t k = 2; k < positions.size(); ++k) {
    const double velocity = (positions[k] - positions[k - 1]) / 0.01;
    const double before = (positions[k - 1] - positions[k - 2]) / 0.01;
    EXPECT_LE(std::abs(velocity), 1.01 * max_velocity);
    EXPECT_LE(std::abs(velocity - before) / 0.01, 1.1 * max_acceleration);
    EXPECT_GE(velocity * way, -1e-9) << "it moved back";
  }
}

TEST(JointTrajectory, MovesTheHeadAndACommanderThatDiesStopsItSmoothly) {
  testing::DeployedRobot janus(example("janus.yaml"));
  ASSERT_EQ(janus.start(), "");
  moves_and_stops_smoothly(janus, "2", 1.2, 2.0, 5.0);
}

TEST(JointTrajectory, MovesTheArmAndACommanderThatDiesStopsItSmoothly) {
  testing::DeployedRobot wam(example("wam.yaml"));
  ASSERT_EQ(wam.start(), "");
  moves_and_stops_smoothly(wam, "7", 0.8, 2.5, 5.0);
}

TEST(JointTrajectory, BrakesAtAStopOfTheCommanderWhateverItsStampAndAtThatOfTheOperator) {
  testing::DeployedRobot janus(example("janus.yaml"));
  ASSERT_EQ(janus.start(), "");
  run_beside(janus, 100ms);
  ASSERT_EQ(janus.arm(), CommandStage::kDone) << janus.reasons();
  run_beside(janus, 600ms);
  auto stops = commander({"joint_trajectory", "2", "1.2", "8", "stop"});
  ASSERT_TRUE(runs_until(janus, [&] { return moves(janus); })) << janus.reasons();
  run_beside(janus, 2s);
  EXPECT_TRUE(moves(janus));
  stops.send(SIGTERM);
  run_beside(janus, 2s);
  EXPECT_FALSE(moves(janus));
  EXPECT_EQ(refused(janus), 0u) << janus.reasons();
  EXPECT_LT(measured(janus), 1.0) << "it went on to the end";
  stops.send(SIGKILL);

  // At the operator's stop it brakes, and its commander, which goes on, is not heard any more.
  auto goes_on = commander({"joint_trajectory", "2", "-0.4", "8"});
  ASSERT_TRUE(runs_until(janus, [&] { return moves(janus); })) << janus.reasons();
  run_beside(janus, 1s);
  EXPECT_EQ(janus.call("Arming", "stop"), "");
  run_beside(janus, 1s);
  const double stopped_at = measured(janus);
  run_beside(janus, 1s);
  EXPECT_FALSE(moves(janus));
  EXPECT_GT(refused(janus), 5u);
  EXPECT_NEAR(measured(janus), stopped_at, 0.01) << "it goes on after the operator's stop";
  goes_on.send(SIGKILL);
}

TEST(JointTrajectory, NeedsAGeneratorThatTheSameOperatorStops) {
  deploy::DeploymentOptions options;
  options.library_folders = {LIBRARIES};
  const auto unstopped =
      deploy::parse_deployment("include: [" EXAMPLES
                               "/13_ros2/janus.yaml]\ncomponents:\n  Generator: {override: true, "
                               "model: nAxesGeneratorTaught, peers: []}\n",
                               "test.yaml", options);
  EXPECT_NE(unstopped.diagnostics.to_text().find("'JointTrajectory': what comes from ROS 2 leads "
                                                 "to the effort"),
            std::string::npos)
      << unstopped.diagnostics.to_text();
}

TEST(JointStates, HaveNoVelocityWhereNothingMeasuresIt) {
  for (const char* file : {"janus.yaml", "wam.yaml"}) {
    testing::DeployedRobot robot(example(file));
    ASSERT_EQ(robot.start(), "");
    const component::Component& states = *robot.application().find("JointStates");
    for (const auto* input : component::interface_of(states).inputs) {
      for (const auto* writer : input->writers()) {
        EXPECT_EQ(writer->owner().name(), "BridgeRef") << file << " " << input->name();
      }
      EXPECT_EQ(input->writers().empty(), input->name() != "Position") << file;
    }
  }
}

TEST(CmdVel, DrivesTheRoverAndACommanderThatDiesStopsIt) {
  testing::DeployedRobot rover(example("rover.yaml"));
  ASSERT_EQ(rover.start(), "");
  const auto speed = [&](const char* side) {
    return rover.value<double>("Chassis.Drive",
                               side == std::string("left") ? "SpeedLeft" : "SpeedRight");
  };
  auto first = commander({"cmd_vel", "0.3", "0.5"});
  const auto heard = [&] {
    return rover.value<std::uint64_t>("CmdVel", "Received") +
           rover.value<std::uint64_t>("CmdVel", "Refused");
  };
  ASSERT_TRUE(runs_until(rover, [&] { return heard() > 5; }));
  EXPECT_NEAR(speed("left"), 0.0, 0.01) << "it drives, and nobody armed it";
  // It goes on sending while the operator arms the rover: that moves nothing.
  ASSERT_EQ(rover.arm(), CommandStage::kDone) << rover.reasons();
  run_beside(rover, 500ms);
  EXPECT_NEAR(speed("right"), 0.0, 0.01) << "it drives on by itself";
  first.send(SIGKILL);
  run_beside(rover, 800ms);
  auto program = commander({"cmd_vel", "0.3", "0.5"});
  ASSERT_TRUE(runs_until(rover, [&] { return speed("right") > 0.33; })) << rover.reasons();
  EXPECT_NEAR(speed("left"), 0.3 - 0.5 * 0.15, 0.05);
  // The operator stops it: it stays where it is, although the program goes on.
  EXPECT_EQ(rover.call("Arming", "stop"), "");
  run_beside(rover, 1s);
  EXPECT_NEAR(speed("right"), 0.0, 0.01) << "it drives on after the operator's stop";
  program.send(SIGKILL);
  run_beside(rover, 800ms);
  auto last = commander({"cmd_vel", "0.3", "0.5"});
  ASSERT_TRUE(runs_until(rover, [&] { return speed("right") > 0.33; })) << rover.reasons();
  last.send(SIGKILL);
  // Its last speeds count for 0.2 s; then it brakes with 1 m/s^2.
  double before = speed("right");
  double hardest = 0.0;
  for (int k = 0; k < 120; ++k) {
    run_beside(rover, 10ms);
    hardest = std::max(hardest, (before - speed("right")) / 0.01);
    before = speed("right");
  }
  EXPECT_NEAR(speed("left"), 0.0, 0.01);
  EXPECT_NEAR(speed("right"), 0.0, 0.01);
  EXPECT_LT(hardest, 8.0) << "it stopped with a jerk";
}

}  // namespace
}  // namespace armature::ros2
