// SPDX-License-Identifier: Apache-2.0
// The control cycle of 2, 7 and 1000 joints, deployed from YAML, beside the same written by hand.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/interface.hpp"
#include "armature/deploy/deployment.hpp"
#include "armature/testing/realtime_guard.hpp"
#include "tests/robot/fake_joint.hpp"

namespace armature {
namespace {

using namespace std::chrono_literals;
using ::testing::DoubleNear;
using ::testing::HasSubstr;
using ::testing::Pointwise;

using Vector = std::vector<double>;
constexpr double kPeriod = 0.010;
constexpr double kDuration = 1.5;  ///< of the motion
constexpr int kSamplesBefore = 5;  ///< the motion, which begins half a period after them
constexpr int kSamplesInAll = 200;

/// Where joint `number` is sent.
double target_of(int number) { return 0.2 + 0.1 * (number % 4); }

/// A trapezoidal velocity from rest to rest, one ramp taking `share` of the time.
struct Motion {
  double start, end, share;

  void at(double time, double& q, double& qd, double& qdd) const {
    const double ramp = share * kDuration;
    const double speed = (end - start) / (kDuration - ramp);
    q = end;
    qd = qdd = 0.0;
    if (time < 0.0) {
      q = start;
    } else if (time < ramp) {
      q = start + 0.5 * speed / ramp * time * time;
      qd = speed / ramp * time;
      qdd = speed / ramp;
    } else if (time <= kDuration - ramp) {
      q = start + speed * (time - 0.5 * ramp);
      qd = speed;
    } else if (time < kDuration) {
      const double left = kDuration - time;
      q = end - 0.5 * speed / ramp * left * left;
      qd = speed / ramp * left;
      qdd = -speed / ramp;
    }
  }
};

/// As share of the shortest motion of an axis with 1 rad/s and 2 rad/s^2.
double ramp_share(double distance) {
  const double length = std::abs(distance);
  return length > 0.5 ? 0.5 / (length + 0.5) : 0.5;
}

/// The voltage of a motor of the deployment.
double voltage_of(double torque, double qd, double qdd) {
  const double at_joint = torque + 1.2e-5 * 100 * 100 * qdd + 0.02 * qd;
  return at_joint * 2.0 / (0.035 * 100) + 0.035 * 100 * qd;
}

/// The whole robot in one loop.
class ByHand {
 public:
  ByHand(int count, bool feed_forward) : feed_forward_(feed_forward) {
    for (int i = 1; i <= count; ++i) joints_.push_back({i, initial_of(i), target_of(i)});
  }

  /// One sampling period; `k` counts from 1. What the generator wrote in the one before is desired.
  void step(int k) {
    for (Joint& joint : joints_) joint.q += gain_of(joint.number) * joint.applied;
    if (k == 1) return;  // nothing is desired yet
    const double time = (k - 1 - kSamplesBefore - 0.5) * kPeriod;
    double above = 0.0;  // acceleration of the links up to here
    for (Joint& joint : joints_) {
      const Motion motion{joint.start, joint.target, ramp_share(joint.target - joint.start)};
      motion.at(time, joint.desired, joint.qd, joint.qdd);
      joint.link_acceleration = above += joint.qdd;
    }
    double force = 0.0;  // of the links from here on
    for (auto joint = joints_.rbegin(); joint != joints_.rend(); ++joint) {
      force += 0.5 * (9.81 + joint->link_acceleration);
      joint->applied = pid(*joint);
      if (feed_forward_) joint->applied += voltage_of(force, joint->qd, joint->qdd);
    }
  }
  Vector positions() const {
    Vector all;
    for (const Joint& joint : joints_) all.push_back(joint.q);
    return all;
  }

 private:
  struct Joint {
    int number;
    double start, target;
    double q = start;
    double applied = 0.0, desired = 0.0, qd = 0.0, qdd = 0.0, link_acceleration = 0.0;
    double u = 0.0, last = 0.0, before = 0.0;
    bool first = true;
  };
  static double pid(Joint& joint) {
    const double error = joint.desired - joint.q;
    if (std::exchange(joint.first, false)) joint.last = joint.before = error;
    joint.u += 30 * (error - joint.last) + 2 * error + 5 * (error - 2 * joint.last + joint.before);
    joint.u = std::clamp(joint.u, -12.0, 12.0);
    joint.before = std::exchange(joint.last, error);
    return joint.u;
  }

  std::vector<Joint> joints_;
  bool feed_forward_;
};

std::string text_of(const std::string& file) {
  std::ifstream stream(std::string(DEPLOYMENTS "/") + file);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// The deployment of `file`, or of a text in its place, with some parameters and properties set, in
/// simulated time.
class Robot {
 public:
  Robot(const std::string& file, int joints, std::vector<std::string> overrides = {})
      : Robot(file, text_of(file), joints, std::move(overrides)) {}

  Robot(const std::string& file, const std::string& text, int joints,
        std::vector<std::string> overrides = {}) {
    deploy::DeploymentOptions options;
    options.library_folders = {LIBRARIES};
    options.document.overrides = std::move(overrides);
    options.document.overrides.push_back("joints=" + std::to_string(joints));
    options.models = [](component::Registry& models) {
      models.add<FakeJoint>("FakeJoint", "a joint without hardware");
    };
    deployment_ = deploy::parse_deployment(text, std::string(DEPLOYMENTS "/") + file, options);
    EXPECT_TRUE(deployment_.ok()) << deployment_.diagnostics.to_text();
    deployment_.options.simulated = true;
    application_ =
        std::make_unique<exec::Application>(std::move(deployment_.blueprint), deployment_.options);
  }

  exec::Application& application() { return *application_; }
  void start() {
    const auto started = application_->start();
    ASSERT_TRUE(started.ok()) << started.to_text();
  }
  void move_to(const Vector& positions, double time) {
    const auto answer = application_->call("Generator", "moveTo",
                                           {types::Value::of(positions), types::Value::of(time)});
    ASSERT_TRUE(answer) << answer.error();
  }
  template <typename T>
  T value(const char* component, const char* item) {
    const auto value = application_->value_of(component, item);
    EXPECT_TRUE(value) << value.error();
    return *static_cast<const T*>(value.value().data());
  }
  Vector positions(int joints) {
    auto measured = value<Vector>("Sensor", "sensor");
    measured.resize(static_cast<std::size_t>(joints));
    return measured;
  }
  component::State state(const char* component) { return application_->find(component)->state(); }
  std::string reason(const char* component) {
    return std::string(application_->find(component)->reason());
  }

 private:
  deploy::Deployment deployment_;
  std::unique_ptr<exec::Application> application_;
};

Vector targets(int joints) {
  Vector all;
  for (int i = 1; i <= joints; ++i) all.push_back(target_of(i));
  return all;
}

/// Links of half a kilogram that slide up on one another.
std::string write_description(int joints) {
  const auto file = std::filesystem::path(::testing::TempDir()) /
                    ("robot_cycle_" + std::to_string(joints) + ".urdf");
  std::ofstream text(file);
  text << "<robot name='tower'><link name='link0'/>";
  for (int i = 1; i <= joints; ++i) {
    text << "<link name='link" << i << "'><inertial><mass value='0.5'/><inertia ixx='0.01' "
         << "iyy='0.01' izz='0.01' ixy='0' ixz='0' iyz='0'/></inertial></link><joint name='joint"
         << i << "' type='prismatic'><parent link='link" << i - 1 << "'/><child link='link" << i
         << "'/><axis xyz='0 0 1'/><limit lower='-4' upper='4' effort='1' velocity='1'/></joint>";
  }
  text << "</robot>";
  return file;
}

class Cycle : public ::testing::TestWithParam<int> {
 protected:
  /// Runs both side by side, and expects equal positions in each period and no allocation.
  void expect_equal(Robot& robot, bool feed_forward) {
    const int joints = GetParam();
    ByHand by_hand(joints, feed_forward);
    robot.start();
    const testing::RealtimeGuard guard;
    robot.application().run_for(5ms);  // from here on, one cycle in each run
    for (int k = 1; k <= kSamplesInAll; ++k) {
      robot.application().run_for(10ms);
      by_hand.step(k);
      ASSERT_THAT(robot.positions(joints), Pointwise(DoubleNear(1e-9), by_hand.positions())) << k;
      if (k == kSamplesBefore) robot.move_to(targets(joints), kDuration);
    }
    EXPECT_EQ(guard.violations(), 0u) << guard.report();
    EXPECT_EQ(robot.value<int>("Sensor", "incomplete_rounds"), 0);
    EXPECT_EQ(robot.value<int>("Controller", "incomplete_rounds"), 0);
    EXPECT_EQ(robot.value<int>("Controller", "samples_without_sensor"), 0);
    EXPECT_EQ(robot.value<int>("Actuator", "samples_without_act"), 1);  // nothing desired yet
    EXPECT_EQ(robot.application().faults(), 0u);
    EXPECT_EQ(robot.application().reactions(), 0u);
  }
};

TEST_P(Cycle, OfIndependentPidsIsThatOfALoopWrittenByHand) {
  Robot robot("cycle.yaml", GetParam());
  expect_equal(robot, false);
}

TEST_P(Cycle, WithFeedForwardIsThatOfALoopWrittenByHand) {
  Robot robot("cycle_feed_forward.yaml", GetParam(),
              {"description=" + write_description(GetParam())});
  expect_equal(robot, true);
}

TEST_P(Cycle, InTheThreadsOfPaperOneIsThatOfALoopWrittenByHand) {
  Robot robot("cycle.yaml", GetParam(),
              {"Sensor.activity={triggered: true, priority: 79}",
               "Controller.activity={triggered: true, priority: 78}",
               "Actuator.activity={triggered: true, priority: 78}",
               "BridgeRef.activity={triggered: true, priority: 40}"});
  expect_equal(robot, false);
}

INSTANTIATE_TEST_SUITE_P(Joints, Cycle, ::testing::Values(2, 7, 1000));

TEST(CycleWithASilentJoint, GoesOnAndCountsTheJoint) {
  Robot robot("cycle.yaml", 7, {"Joint3.silent_in=[20, 40, 41]"});
  robot.start();
  const testing::RealtimeGuard guard;
  robot.application().run_for(999ms);
  EXPECT_EQ(guard.violations(), 0u) << guard.report();
  EXPECT_EQ(robot.value<int>("Sensor", "incomplete_rounds"), 3);
  EXPECT_EQ(robot.value<std::vector<int>>("Sensor", "missing"),
            std::vector<int>({0, 0, 3, 0, 0, 0, 0}));
  EXPECT_EQ(robot.value<component::Reason>("Sensor", "missing_names").view(), "Joint3");
  EXPECT_EQ(robot.application().faults(), 0u);
  EXPECT_EQ(robot.state("Joint3"), component::State::kRunning);
}

TEST(CycleWithASilentJoint, StopsTheRobotAfterThreePeriodsInARowAndSaysWhy) {
  Robot robot("cycle.yaml", 7, {"Joint3.silent_in=[20, 21, 22]"});
  robot.start();
  robot.application().run_for(500ms);
  EXPECT_EQ(robot.state("Sensor"), component::State::kException);
  EXPECT_EQ(robot.reason("Sensor"), "Joint3 (number 3) did not answer in 3 rounds in a row");
  for (const char* each : {"Controller", "PID1", "Actuator", "Joint1", "Joint7"}) {
    EXPECT_EQ(robot.state(each), component::State::kStopped) << each;
    EXPECT_THAT(robot.reason(each), HasSubstr("the component that writes it is out of service"));
  }
}

/// Where the sensor's value is a cycle late, too, each Sample is one computation.
TEST(CycleWithADelay, ComputesOnceForEachSample) {
  std::string text = text_of("cycle.yaml");
  const std::string plain = "- Sensor.sensor -> Controller.sensor\n";
  text.replace(text.find(plain), plain.size(),
               "- {from: Sensor.sensor, to: Controller.sensor, delay: one_cycle}\n");
  for (const bool in_threads : {false, true}) {
    std::vector<std::string> overrides;
    if (in_threads) overrides = {"Controller.activity={triggered: true, priority: 78}"};
    Robot robot("cycle.yaml", text, 2, overrides);
    robot.start();
    robot.application().run_for(505ms);
    const auto& outputs = component::interface_of(*robot.application().find("Controller")).outputs;
    const auto act = std::find_if(outputs.begin(), outputs.end(),
                                  [](const auto* output) { return output->name() == "act"; });
    EXPECT_GE((*act)->current_sequence(), 48u) << in_threads;
    EXPECT_EQ(robot.value<int>("Controller", "sensor_without_sample"), 0) << in_threads;
    EXPECT_LE(robot.value<int>("Controller", "samples_without_sensor"), 1) << in_threads;
  }
}

TEST(CycleWithoutSamples, StopsTheRobotAsSoonAsTheDataIsTooOld) {
  Robot robot("cycle.yaml", 2);
  robot.start();
  robot.application().run_for(500ms);
  ASSERT_TRUE(robot.application().stop_component("Sampler"));
  robot.application().run_for(80ms);
  EXPECT_EQ(robot.state("Controller"), component::State::kRunning);
  robot.application().run_for(40ms);
  for (const char* each : {"Controller", "Actuator", "Joint1", "Joint2"}) {
    EXPECT_EQ(robot.state(each), component::State::kStopped) << each;
  }
}

/// The deployment `text` with a maximum age of a second for each connection.
std::string with_ages(const std::string& text) {
  const std::string arrow = " -> ";
  std::istringstream lines(text);
  std::string result;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find(arrow);
    const std::size_t begin = line.find("- ") + 2;
    if (at == std::string::npos) {
      result += line + "\n";
    } else {
      result += "  - {from: \"" + line.substr(begin, at - begin) + "\", to: \"" +
                line.substr(at + arrow.size()) + "\", max_age: 1 s}\n";
    }
  }
  return result;
}

TEST(CycleWithoutSamples, MayLastAsLongAsTheConnectionsSay) {
  Robot robot("cycle.yaml", with_ages(text_of("cycle.yaml")), 2);
  robot.start();
  robot.application().run_for(500ms);
  ASSERT_TRUE(robot.application().stop_component("Sampler"));
  robot.application().run_for(900ms);
  EXPECT_EQ(robot.state("Controller"), component::State::kRunning);
  EXPECT_EQ(robot.state("Joint1"), component::State::kRunning);
  robot.application().run_for(200ms);
  EXPECT_EQ(robot.state("Controller"), component::State::kStopped);
  EXPECT_EQ(robot.state("Joint1"), component::State::kStopped);
}

}  // namespace
}  // namespace armature
