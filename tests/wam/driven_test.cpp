// SPDX-License-Identifier: Apache-2.0
// The armed arm under what should not drive it: a load that nobody knows, a hand, torques that
// shake, and a generator that is too fast for the safety board.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <string_view>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/interface.hpp"
#include "robots/wam/tip_speed.hpp"
#include "tests/wam/arm.hpp"

namespace armature::wam {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

/// Armed and at rest, with the forearm stretched out; the test is its controller or its generator.
class WamDriven : public ::testing::Test {
 protected:
  WamDriven() : arm("npid7.yaml") {
    arm.start_armed();
    arm.run_for(1500ms);
    EXPECT_EQ(arm.move_to({-1.5, 1.0, 0.0, 0.4, 0.0, 0.0, 0.0}, 6.0), "");
    arm.run_for(8s);
    EXPECT_TRUE(arm.armed()) << arm.log;
  }
  void write(const char* component, std::string_view port, const Vector& value) {
    component::Component& writer = *arm.application().find(component);
    for (component::OutputPortBase* output : component::interface_of(writer).outputs) {
      if (output->name() != port) continue;
      ASSERT_TRUE(arm.application().run_in_thread_of(writer, [&] { output->write_from(&value); }));
      return;
    }
    FAIL() << component << " has no output " << port;
  }
  /// In the place of the controller: torques beside the weight, for so many cycles or until it is
  /// disarmed. @return what it has said since
  template <typename Torque>
  std::string drive(int cycles, const Torque& torque_of_joint_2) {
    arm.log.clear();
    EXPECT_TRUE(arm.application().stop_component("Controller"));
    for (int cycle = 0; cycle < cycles && arm.armed(); ++cycle) {
      Vector torques = hold_others();
      torques[1] = torque_of_joint_2(cycle);
      write("Actuator", "Torque", torques);
      arm.cycle();
    }
    return arm.log;
  }
  /// Where they were when it began, but for joint 2.
  Vector hold_others() {
    const Vector now = arm.positions();
    if (last_.empty()) place_ = last_ = now;
    Vector torques(now.size(), 0.0);
    for (std::size_t i = 0; i < now.size(); ++i) {
      const double kp = i < 4 ? 200.0 : 10.0;
      const double kd = i < 4 ? 10.0 : 0.2;
      if (i != 1) torques[i] = kp * (place_[i] - now[i]) - kd * (now[i] - last_[i]) / 0.002;
    }
    last_ = now;
    return torques;
  }
  void expect_held() {
    EXPECT_FALSE(arm.armed());
    EXPECT_EQ(arm.state("WAM"), component::State::kRunning) << arm.reason("WAM");
    EXPECT_EQ(arm.safety_state(), "ACTIVATED");
    arm.run_for(1500ms);
    const Vector rest = arm.positions();
    arm.run_for(2s);
    EXPECT_LT(largest_apart(arm.positions(), rest), 0.002);
    EXPECT_EQ(arm.state("WAM"), component::State::kRunning) << arm.reason("WAM");
  }

  Arm arm;

 private:
  Vector place_;
  Vector last_;
};

TEST_F(WamDriven, AnArmWithALoadThatNobodyKnowsIsHeldInsteadOfSinking) {
  const double begin = arm.positions()[1];
  const double down = arm.hardware().torque_path().weight()[1] > 0.0 ? -1.0 : 1.0;
  const std::string said = drive(10'000, [&](int) { return 2.0 * down; });
  EXPECT_THAT(said, HasSubstr("sinks, and nothing drives it down: by 0.5"));
  expect_held();
  const double sunk = std::abs(arm.positions()[1] - begin);
  EXPECT_GT(sunk, 0.4) << "it did sink";
  EXPECT_LT(sunk, 0.9);
}

TEST_F(WamDriven, AWeightlessArmStaysArmedAndWhereItIs) {
  const double begin = arm.positions()[1];
  drive(5000, [](int) { return 0.0; });
  EXPECT_TRUE(arm.armed()) << arm.log;
  EXPECT_NEAR(arm.positions()[1], begin, 0.05);
}

TEST_F(WamDriven, ControllersThatShakeItAreCutOff) {
  const std::string said = drive(1000, [](int cycle) { return cycle % 2 == 0 ? 20.0 : -20.0; });
  EXPECT_THAT(said, HasSubstr("joint 2 shakes: what drives it has changed its sign in 0.2"));
  expect_held();
}

TEST_F(WamDriven, AControllerThatDrivesItAwayIsCutOff) {
  const double up = arm.hardware().torque_path().weight()[1] > 0.0 ? 1.0 : -1.0;
  const std::string said = drive(1000, [&](int) { return 12.0 * up; });
  EXPECT_THAT(said, HasSubstr("joint 2 should stand still but is driven away: by 0.1"));
  expect_held();
}

TEST_F(WamDriven, AGeneratorOfItsOwnThatIsTooFastForTheBoardIsCutOffAndTheArmIsHeld) {
  arm.log.clear();
  ASSERT_TRUE(arm.application().stop_component("Generator"));
  Vector position = arm.desired();
  Vector velocity(arm.joints(), 0.0);
  Vector acceleration(arm.joints(), 0.0);
  double fastest = 0.0;
  for (int cycle = 0; cycle < 2000 && arm.armed(); ++cycle) {
    acceleration[0] = velocity[0] < 1.6 ? 3.0 : 0.0;
    velocity[0] += 0.002 * acceleration[0];
    position[0] += 0.002 * velocity[0];
    write("Generator", "nAxesDesiredPosition", position);
    write("Generator", "nAxesDesiredVelocity", velocity);
    write("Generator", "nAxesDesiredAcceleration", acceleration);
    const Vector before = arm.positions();
    arm.cycle();
    Vector speed = arm.positions();
    for (std::size_t i = 0; i < speed.size(); ++i) speed[i] = (speed[i] - before[i]) / 0.002;
    fastest = std::max(fastest, TipSpeed::of(arm.positions(), speed));
  }
  EXPECT_THAT(arm.log, HasSubstr("the tip gets too fast: "));
  EXPECT_GT(fastest, 0.9);
  expect_held();
}

// ---- E-stop in the middle of everything

struct Moment {
  const char* name;
  /// Brings the arm there, which is armed and at rest.
  void (*begin)(Arm& arm);
};

class WamEstop : public WamDriven, public ::testing::WithParamInterface<Moment> {};
INSTANTIATE_TEST_SUITE_P(
    InTheMiddleOf, WamEstop,
    ::testing::Values(Moment{"Arming",
                             [](Arm& arm) {
                               ASSERT_EQ(arm.call("Arming", "disarm"), "");
                               arm.run_for(1s);
                               ASSERT_EQ(arm.call("Arming", "arm"), "");
                               arm.run_for(6ms);
                             }},
                      Moment{"HandingOver",
                             [](Arm& arm) {
                               ASSERT_EQ(arm.call("Arming", "disarm"), "");
                               arm.run_for(100ms);
                             }},
                      Moment{"AMotion",
                             [](Arm& arm) {
                               ASSERT_EQ(arm.move_to({0.5, 1.2, 0.0, 1.0, 0.0, 0.0, 0.0}, 5.0), "");
                               arm.run_for(2s);
                             }},
                      Moment{"BrakingFromIt",
                             [](Arm& arm) {
                               ASSERT_EQ(arm.move_to({0.5, 1.2, 0.0, 1.0, 0.0, 0.0, 0.0}, 5.0), "");
                               arm.run_for(2s);
                               ASSERT_EQ(arm.call("Arming", "stop"), "");
                               arm.run_for(100ms);
                             }},
                      Moment{"GoingHome",
                             [](Arm& arm) {
                               ASSERT_TRUE(arm.application().stop_component("WAM"));
                               arm.run_for(2s);
                               ASSERT_EQ(arm.state("WAM"), component::State::kRunning);
                             }},
                      Moment{"BeingWeightless",
                             [](Arm& arm) {
                               ASSERT_TRUE(arm.application().stop_component("Controller"));
                               arm.cycle();
                             }}),
    [](const auto& tested) { return std::string(tested.param.name); });

TEST_P(WamEstop, EndsAllTorquesAtOnceAndNothingGoesOnAfterIt) {
  GetParam().begin(arm);
  ASSERT_EQ(arm.call("WAM", "estop"), "");
  arm.run_for(10ms);
  for (const double torque : arm.motor_torques()) EXPECT_EQ(torque, 0.0);
  arm.run_for(500ms);
  EXPECT_EQ(arm.state("WAM"), component::State::kException);
  EXPECT_THAT(arm.reason("WAM"), HasSubstr("E-stop, positions are lost"));
  EXPECT_EQ(arm.hardware().torque_path().mode(), TorquePath::Mode::kOff);
  ASSERT_EQ(arm.call("WAM", "releaseEstop"), "");
  arm.run_for(2s);
  for (const double torque : arm.motor_torques()) EXPECT_EQ(torque, 0.0);
}

}  // namespace
}  // namespace armature::wam
