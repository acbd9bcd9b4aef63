// SPDX-License-Identifier: Apache-2.0
// The hardware's component alone, on the emulated arm.
#include "robots/wam/wam_hardware.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/host.hpp"
#include "armature/testing/harness.hpp"
#include "robots/wam/test_arms.hpp"

namespace armature::wam {
namespace {

using namespace std::chrono_literals;
using ::testing::Contains;
using ::testing::HasSubstr;

class WamHardwareTest : public ::testing::Test {
 protected:
  WamHardwareTest() : bench(std::make_unique<WamHardware>("WAM"), 2ms) {
    component::Host::context(bench.component()).simulated = true;
    bench.set("joints", 4);
    bench.set("Period", 0.002);
    bench.set("robot_description", description_of(wam4()));
    bench.set("PositionMin", Vector{-3.0});
    bench.set("PositionMax", Vector{3.2});
    for (const char* limit : {"MaxVelocity", "MaxAcceleration", "MaxTorqueGrowth"}) {
      bench.set(limit, Vector{5.0});
    }
    for (const char* most : {"MaxControlTorque", "MaxTorque"}) bench.set(most, Vector{50.0});
  }
  std::string refusal() { return std::string(bench.start().reason()); }
  void start() { ASSERT_TRUE(bench.start()) << bench.reason(); }
  void cycle(int times = 1) {
    for (int i = 0; i < times; ++i) {
      bench.advance(2ms);
      EXPECT_TRUE(bench.call<bool>("getJointSensorsOperation").value());
    }
  }
  const Vector& data() { return bench.output<Vector>("jointsDataPort"); }
  WamHardware& hardware() { return static_cast<WamHardware&>(bench.component()); }

  testing::Harness bench;
};

TEST_F(WamHardwareTest, AReadingHasPositionsVelocitiesAndTorquesOfAllJoints) {
  start();
  cycle(200);
  const Vector weight(hardware().torque_path().weight().begin(),
                      hardware().torque_path().weight().end());
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(data()[i], wam4().home[i], 1e-3);
    EXPECT_NEAR(data()[4 + i], 0.0, 0.05);
    EXPECT_NEAR(data()[8 + i], weight[i], 0.5);
  }
}

TEST_F(WamHardwareTest, IsReadOnceInACycleWhoeverAsks) {
  start();
  cycle(10);
  const std::uint64_t answers = hardware().emulated()->emulator().puck(0).counters().answers;
  bench.advance(2ms);
  bench.raise("Sample");
  for (int i = 0; i < 2; ++i) EXPECT_TRUE(bench.call<bool>("getJointSensorsOperation").value());
  EXPECT_EQ(hardware().emulated()->emulator().puck(0).counters().answers, answers + 1);
}

TEST_F(WamHardwareTest, ItsOwnControllerAnswersPositionsWithTheTorquesOfItsLaw) {
  start();
  cycle(200);
  auto law = JointController::make({.gains = wam4().gains}).value();
  Vector reference(data().begin(), data().begin() + 4);
  reference[0] += 2e-4;
  Vector expected(4);
  for (int i = 0; i < 10; ++i) {
    cycle();
    if (i == 0) law.reset_to(reference, Vector(data().begin(), data().begin() + 4));
    law.step(reference, Vector(data().begin(), data().begin() + 4), expected);
    bench.write("posRefPort", reference);
    EXPECT_EQ(bench.output<Vector>("ControlDataPort"), expected);
  }
  EXPECT_GT(expected[0], 0.1);
}

TEST_F(WamHardwareTest, ItsOwnControllerHasNoPastAfterAPause) {
  start();
  cycle(200);
  Vector reference(data().begin(), data().begin() + 4);
  reference[0] += 1e-3;
  const auto torque = [&] {
    cycle();
    reference[0] = data()[0] + 1e-3;
    bench.write("posRefPort", reference);
    return bench.output<Vector>("ControlDataPort")[0];
  };
  const double first = torque();
  EXPECT_NEAR(first, wam4().gains[0].kp * 1e-3, 0.01) << "it does not kick";
  for (int i = 0; i < 2000; ++i) torque();
  EXPECT_GT(torque(), first + 0.005) << "the integral";
  cycle(10);
  EXPECT_NEAR(torque(), first, 1e-9);
}

TEST_F(WamHardwareTest, KeysOfThePendantArePressedByItsOwnCommands) {
  start();
  cycle(200);
  ASSERT_EQ(hardware().emulated()->emulator().board().mode(), BoardMode::kActive);
  EXPECT_TRUE(bench.call("shiftIdle"));
  cycle();
  EXPECT_EQ(hardware().emulated()->emulator().board().mode(), BoardMode::kIdle);
}

TEST_F(WamHardwareTest, ARunThatFindsTheArmActiveHasItIdledFirst) {
  start();
  cycle(200);
  bench.stop();
  ASSERT_TRUE(component::Host::start(bench.component()));
  cycle(30);
  EXPECT_EQ(hardware().torque_path().mode(), TorquePath::Mode::kOff);
  EXPECT_THAT(bench.log(), Contains(HasSubstr("waits for Shift+Idle, then Shift+Activate: the arm "
                                              "was active before")));
  cycle(200);
  EXPECT_EQ(hardware().torque_path().mode(), TorquePath::Mode::kHolding);
}

TEST_F(WamHardwareTest, TheGainsThatCountAreShown) {
  start();
  std::vector<double> vendors;
  for (const JointGains& joint : wam4().gains) vendors.push_back(joint.kp);
  const auto shown = [&] {
    for (const component::PropertyBase* one : component::interface_of(hardware()).properties) {
      if (one->name() == "Kp") return *static_cast<const Vector*>(one->data());
    }
    return Vector{};
  };
  EXPECT_EQ(shown(), vendors);
  bench.stop();
  component::Host::cleanup(hardware());
  bench.set("Kp", Vector{500.0});
  ASSERT_TRUE(bench.start()) << bench.reason();
  EXPECT_EQ(shown(), Vector{500.0});
}

/// What does not fit the arm, and passed every check.
struct Misfit {
  const char* name;
  const char* property;
  Vector value;
  base::Duration period = 2ms;
  const char* says = "do not fit the arm";
};
class UnfitForTheArm : public WamHardwareTest, public ::testing::WithParamInterface<Misfit> {
 protected:
  /// How far any joint is from where it was [rad].
  double moved_from(const Vector& begin) {
    double most = 0.0;
    for (std::size_t i = 0; i < begin.size(); ++i) {
      most = std::max(most, std::abs(position(i) - begin[i]));
    }
    return most;
  }
  double position(std::size_t joint) {
    return hardware().emulated()->motors().arm().joint_position(joint);
  }
};
INSTANTIATE_TEST_SUITE_P(
    Is, UnfitForTheArm,
    ::testing::Values(Misfit{"GainsOfAThousandTimes", "Kp", {900e3, 2500e3, 600e3, 500e3}},
                      Misfit{"DampingOfAThousandTimes", "Kd", {10e3, 20e3, 5e3, 2e3}},
                      Misfit{"GravityOfTenTimes", "gravity", {0.0, 0.0, -98.05}},
                      Misfit{"GravityOfTheWrongSign", "gravity", {0.0, 0.0, 9.805}},
                      Misfit{"ASamplerOfTenTimesThePeriod",
                             "Kp",
                             {900.0, 2500.0, 600.0, 500.0},
                             20ms,
                             "it is sampled after 20 ms, but its period is 2 ms"}),
    [](const auto& tested) { return std::string(tested.param.name); });

TEST_P(UnfitForTheArm, ItIsBrakedAtOnceAndSaysWhyOrStandsWithinTheBound) {
  bench.set(GetParam().property, GetParam().value);
  bench.set("MaxTorque", Vector{300.0});
  bench.set("MaxTorqueGrowth", Vector{300.0});
  start();
  Vector begin;
  for (std::size_t i = 0; i < 4; ++i) begin.push_back(position(i));
  double until_braked = 0.0;
  for (int i = 0; i < 3000 && hardware().state() == component::State::kRunning; ++i) {
    bench.advance(GetParam().period);
    bench.raise("Sample");
    until_braked = std::max(until_braked, moved_from(begin));
  }
  if (hardware().state() == component::State::kRunning) {
    EXPECT_LT(until_braked, 0.01) << "its gains hold it";
    return;
  }
  EXPECT_THAT(bench.reason(), HasSubstr(GetParam().says));
  EXPECT_LT(until_braked, 0.03);
}

TEST_F(WamHardwareTest, ABusThatIsNotThereIsNamed) {
  bench.set("bus", "virtual:/nowhere/wam.bus");
  EXPECT_THAT(refusal(), HasSubstr("/nowhere/wam.bus"));
}

TEST_F(WamHardwareTest, MistakesInItsPropertiesAreNamed) {
  bench.set("MaxTorque", Vector{50.0, 50.0});
  EXPECT_THAT(refusal(), HasSubstr("MaxTorque"));
  bench.set("MaxTorque", Vector{50.0});
  bench.set("robot_description", description_of(wam7()));
  EXPECT_THAT(refusal(), HasSubstr("wam7.urdf moves 7 joints, expected joints = 4"));
  bench.set("joints", 5);
  EXPECT_THAT(refusal(), HasSubstr("joints is 5, expected 4, or 7 with the wrist"));
}

}  // namespace
}  // namespace armature::wam
