// SPDX-License-Identifier: Apache-2.0
#include "robots/janus/head.hpp"

#include <chrono>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/testing/realtime_guard.hpp"

namespace armature::janus {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

constexpr const char* kUrdf = ROBOT_FOLDER "/janus.urdf";
constexpr std::size_t kPan = 0;
constexpr std::size_t kTilt = 1;

// By the numbers of the head, not by its URDF.
constexpr double kWeight = 1.1 * 9.81 * 0.08;  // torque about the tilt axis where it is level
constexpr double kRotor = 0.12;
constexpr double kTiltInertia = 0.007 + 1.1 * 0.08 * 0.08 + kRotor;
constexpr double kPanInertia = 0.004 + 0.003 + 1.1 * 0.08 * 0.08 + kRotor;  // while level
constexpr double kTorqueOfVolt = 0.035 * 100.0 / 2.0;                       // at rest
constexpr double kBackEmf = 0.035 * 100.0;

std::unique_ptr<Head> make(const Head::Config& config = {.urdf_file = kUrdf}) {
  auto made = Head::load(config);
  EXPECT_TRUE(made.ok()) << made.error();
  return std::move(made).value();
}

std::string without(std::string text, const std::string& what) {
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what)) {
    text.erase(at, what.size());
  }
  return text;
}

/// The same head whose joints turn without friction.
std::unique_ptr<Head> make_frictionless(const Head::Config& config = {.urdf_file = kUrdf}) {
  std::ostringstream urdf;
  urdf << std::ifstream(kUrdf).rdbuf();
  auto made =
      Head::parse(without(urdf.str(), R"(<dynamics damping="0.02" friction="0.08"/>)"), config);
  EXPECT_TRUE(made.ok()) << made.error();
  return std::move(made).value();
}

TEST(Head, TheFreeFallOfTheTiltJointTurnsHeightIntoSpeed) {
  const auto head = make_frictionless({.urdf_file = kUrdf, .initial_position = {0.0, 3.0}});
  head->wiring(kTilt).release_brake(base::Time{});
  for (auto now = base::Time(10ms); head->position(kTilt, now) < 4.4; now += 10ms) {
    const double height = std::sin(head->position(kTilt, now)) - std::sin(3.0);
    const double velocity = head->velocity(kTilt, now);
    ASSERT_NEAR(0.5 * kTiltInertia * velocity * velocity, -kWeight * height, 5e-4 * kWeight);
    ASSERT_LT(now, base::Time(2s)) << "it falls";
  }
}

TEST(Head, WithoutItsBrakeTheLevelTiltJointBeginsToFallAsItsInertiaLetsIt) {
  const auto head = make();
  head->wiring(kTilt).release_brake(base::Time{});
  const double acceleration = (kWeight - 0.08) / kTiltInertia;
  EXPECT_NEAR(head->velocity(kTilt, base::Time(10ms)), -acceleration * 0.01,
              0.01 * acceleration * 0.01);
}

TEST(Head, TheBrakeHoldsTheTiltJointUnderItsLoadAndAgainstTheFullMotor) {
  const auto head = make();
  EXPECT_NEAR(head->position(kTilt, base::Time(10s)), 0.0, 1e-7);
  head->wiring(kTilt).drive(1.0, base::Time(10s));
  EXPECT_NEAR(head->position(kTilt, base::Time(20s)), 0.0, 1e-6);
  head->wiring(kTilt).drive(-1.0, base::Time(20s));
  EXPECT_NEAR(head->position(kTilt, base::Time(30s)), 0.0, 1e-6);
  EXPECT_EQ(head->wiring(kTilt).take_counts(base::Time(30s)), 0) << "not one count";
}

TEST(Head, TheJointWithoutBrakeDoesNotCareForItsCommands) {
  const auto head = make();
  head->wiring(kPan).apply_brake(base::Time{});
  head->wiring(kPan).drive(1.0, base::Time{});
  EXPECT_GT(head->position(kPan, base::Time(500ms)), 0.5);
}

TEST(Head, AVoltageBelowStaticFrictionDoesNotMoveAJoint) {
  const auto head = make();
  const double most = 0.08 / kTorqueOfVolt / kSupplyVoltage;
  head->wiring(kPan).drive(0.99 * most, base::Time{});
  EXPECT_NEAR(head->position(kPan, base::Time(10s)), 0.0, 1e-8);
  head->wiring(kPan).drive(1.01 * most, base::Time(10s));
  EXPECT_GT(head->position(kPan, base::Time(20s)), 1e-4);
}

TEST(Head, AMotorReachesTheSteadySpeedOfItsVoltage) {
  // Where the motor's torque is that of friction: k N (V - k N w) / R = 0.08 + 0.02 w.
  constexpr double kVoltage = 3.0;
  constexpr double kSpeed = (kTorqueOfVolt * kVoltage - 0.08) / (kTorqueOfVolt * kBackEmf + 0.02);
  const auto head = make();
  head->wiring(kPan).drive(kVoltage / kSupplyVoltage, base::Time{});
  EXPECT_NEAR(head->velocity(kPan, base::Time(1s)), kSpeed, 1e-6);
  EXPECT_NEAR(head->wiring(kPan).motor_current(base::Time(1s)),
              (kVoltage - kBackEmf * kSpeed) / 2.0, 1e-6);
}

TEST(Head, AMotorComesToSpeedWithItsMechanicalTimeConstant) {
  constexpr double kDamping = kTorqueOfVolt * kBackEmf + 0.02;
  constexpr double kVoltage = 3.0;
  constexpr double kSpeed = (kTorqueOfVolt * kVoltage - 0.08) / kDamping;
  const auto head = make();
  head->wiring(kPan).drive(kVoltage / kSupplyVoltage, base::Time{});
  for (auto now = base::Time(5ms); now <= base::Time(100ms); now += 5ms) {
    const double t = std::chrono::duration<double>(now.time_since_epoch()).count();
    ASSERT_NEAR(head->velocity(kPan, now), kSpeed * (1.0 - std::exp(-t * kDamping / kPanInertia)),
                0.005 * kSpeed);
  }
}

TEST(Head, AMotorThatIsOffDoesNotBrakeOneWithoutVoltageDoes) {
  const auto speed_after = [](auto&& stop) {
    const auto head = make();
    head->wiring(kPan).drive(0.25, base::Time{});
    head->advance_to(base::Time(500ms));
    stop(head->wiring(kPan));
    return head->velocity(kPan, base::Time(600ms));
  };
  const double off = speed_after([](AicWiring& wiring) { wiring.switch_off(base::Time(500ms)); });
  const double shorted =
      speed_after([](AicWiring& wiring) { wiring.drive(0.0, base::Time(500ms)); });
  EXPECT_GT(off, 0.7);
  EXPECT_NEAR(shorted, 0.0, 0.01);
}

TEST(Head, TheEncodersCountTwoThousandPerTurnOfTheMotor) {
  const auto head = make({.urdf_file = kUrdf, .initial_position = {1.0, 0.0}});
  AicWiring& wiring = head->wiring(kPan);
  EXPECT_EQ(wiring.take_counts(base::Time{}), 0) << "they are incremental";
  wiring.drive(0.25, base::Time{});
  std::int64_t counts = 0;
  for (auto now = base::Time(10ms); now <= base::Time(1s); now += 10ms) {
    counts += wiring.take_counts(now);
  }
  const double turned = head->position(kPan, base::Time(1s)) - 1.0;
  EXPECT_NEAR(static_cast<double>(counts), turned / (2.0 * std::numbers::pi) * 200'000.0, 1.0);
}

TEST(Head, TheIndexSwitchIsClosedAroundZero) {
  const auto closed_at = [](double position) {
    const auto head = make({.urdf_file = kUrdf, .initial_position = {position, position}});
    return head->wiring(kTilt).index_closed(base::Time{});
  };
  EXPECT_TRUE(closed_at(0.0));
  EXPECT_TRUE(closed_at(-0.0099));
  EXPECT_TRUE(closed_at(0.0099));
  EXPECT_FALSE(closed_at(-0.0101));
  EXPECT_FALSE(closed_at(0.0101));
}

TEST(Head, TheJointsStopAtTheEndsOfTheirRange) {
  const auto head = make();
  head->wiring(kPan).drive(0.3, base::Time{});
  EXPECT_NEAR(head->position(kPan, base::Time(10s)), 4.5, 0.005);
  head->wiring(kPan).drive(-0.3, base::Time(10s));
  EXPECT_NEAR(head->position(kPan, base::Time(20s)), -0.5, 0.005);
}

TEST(Head, BetweenInnerStepsAJointMovesOn) {
  const auto head = make();
  head->wiring(kPan).drive(0.25, base::Time{});
  const double before = head->position(kPan, base::Time(500ms + 99us));
  const double after = head->position(kPan, base::Time(500ms + 100us));
  EXPECT_NEAR(after - before, head->velocity(kPan, base::Time(500ms)) * 1e-6, 1e-9);
}

TEST(Head, HowOftenItIsLookedAtChangesNothing) {
  const auto often = make();
  const auto once = make();
  for (const auto* head : {&often, &once}) {
    (*head)->wiring(kPan).drive(0.5, base::Time{});
    (*head)->wiring(kTilt).release_brake(base::Time{});
  }
  for (auto now = base::Time{}; now < base::Time(300ms); now += 37us) often->position(kPan, now);
  EXPECT_EQ(often->position(kPan, base::Time(300ms)), once->position(kPan, base::Time(300ms)));
  EXPECT_EQ(often->position(kTilt, base::Time(300ms)), once->position(kTilt, base::Time(300ms)));
}

TEST(Head, ItStandsStillAndSaysSoWhenItsNumbersHaveDiverged) {
  const auto head = make();
  head->wiring(kPan).drive(0.25, base::Time{});
  const double before = head->position(kPan, base::Time(500ms));
  EXPECT_EQ(head->status(), sim::PlantStatus::kGood);
  head->wiring(kPan).drive(std::nan(""), base::Time(500ms));
  EXPECT_EQ(head->position(kPan, base::Time(10s)), before);
  EXPECT_EQ(head->velocity(kPan, base::Time(10s)), 0.0);
  EXPECT_EQ(head->status(), sim::PlantStatus::kDiverged);
}

TEST(Head, AllocatesNothingWhileItSteps) {
  const auto head = make();
  testing::RealtimeGuard guard;
  const auto violations = guard.watch([&] {
    for (int i = 1; i <= 100; ++i) {
      const base::Time now(i * 10ms);
      for (std::size_t joint = 0; joint < kJoints; ++joint) {
        head->wiring(joint).drive(std::sin(0.1 * i), now);
        head->wiring(joint).take_counts(now);
        head->wiring(joint).index_closed(now);
        head->wiring(joint).motor_current(now);
      }
      if (i % 10 == 0) head->wiring(kTilt).release_brake(now);
      if (i % 10 == 5) head->wiring(kTilt).apply_brake(now);
    }
  });
  EXPECT_EQ(violations, 0u) << guard.report();
}

TEST(Head, AnotherRobotsFileIsRefused) {
  EXPECT_THAT(Head::load({.urdf_file = "/nowhere/janus.urdf"}).error(),
              HasSubstr("/nowhere/janus.urdf: cannot be read"));
  const std::string one_joint =
      "<robot name='r'><link name='base'/><joint name='joint1' type='continuous'>"
      "<parent link='base'/><child link='a'/></joint><link name='a'><inertial><mass value='1'/>"
      "<inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link></robot>";
  EXPECT_THAT(
      Head::parse(one_joint, {.urdf_file = "one.urdf"}).error(),
      HasSubstr(
          "one.urdf: the armature of joint 'joint2' is given, but the description has no such"));
}

}  // namespace
}  // namespace armature::janus
