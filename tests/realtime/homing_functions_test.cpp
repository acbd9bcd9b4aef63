// SPDX-License-Identifier: Apache-2.0
// Joints that home by themselves: until they are home, and until they have failed.
#include <memory>
#include <string>

#include "armature/component/face.hpp"
#include "armature/component/host.hpp"
#include "armature/component/interface.hpp"
#include "armature/control/absolute_position.hpp"
#include "armature/control/homing/homing_motion.hpp"
#include "armature/controllers/joint/joint.hpp"
#include "armature/testing/harness.hpp"
#include "tests/realtime/expect_realtime.hpp"

namespace armature::controllers {
namespace {

using component::CommandStage;
using control::HomeSign;
using control::HomingMotion;

HomingMotion motion_to(HomeSign sign) {
  return HomingMotion::make({.sign = sign,
                             .velocity = -0.2,
                             .acceleration = 4.0,
                             .travel = 1.0,
                             .back_off = 0.05,
                             .tolerance = 0.01,
                             .lead = 0.01,
                             .period_s = 0.005})
      .value();
}

TEST(RealtimeFunctions, HomingMotionToItsEnd) {
  for (const HomeSign sign :
       {HomeSign::kIndex, HomeSign::kSwitch, HomeSign::kSwitchThenIndex, HomeSign::kHardStop}) {
    HomingMotion motion = motion_to(sign);
    double way = 0.0;
    int ends = 0;
    expect_realtime("HomingMotion::begin", [&] {
      way = 0.0;
      motion.begin(false);
    });
    expect_realtime("HomingMotion::step", [&] {
      for (int k = 0; k < 100; ++k) {
        const auto status = motion.step(
            {.way = way, .switch_closed = way<-0.3, .index_passed = way> - 0.25 && way < -0.24});
        way = std::max(-0.5, way + motion.velocity() * 0.005);
        if (status == HomingMotion::Status::kGoesOn) continue;
        ++ends;
        way = 0.0;
        motion.begin(false);
      }
    });
    EXPECT_GT(ends, 3);
  }
}

TEST(RealtimeFunctions, AbsolutePositionThatIsFoundToBeElsewhere) {
  auto position =
      control::AbsolutePosition::make({.ratio = 0.01, .offset = 1.0, .max_velocity = 1.0}).value();
  position.step(10.0, 0.0);
  expect_realtime("AbsolutePosition::shift", [&] { position.shift(0.5); });
  EXPECT_DOUBLE_EQ(position.position(), 1.1 + 101 * 0.5);
}

/// Who could disarm it.
class Arms final : public component::Component {
 public:
  Arms() : Component("Arming") {}
  void connect(component::EventHandlerBase& handler) { face(arm_).subscribe(handler); }

 private:
  component::Event<> arm_{this, "Arm", "lets it move"};
};

/// Its drive does what it is told, and its switch is closed 0.05 rad below where it began.
template <JointCommand kWay>
class HomedJoint {
 public:
  HomedJoint() {
    joint.set("PeerName", "Card");
    joint.set("Brake", true);
    joint.set("GearRatio", 1.0);
    joint.set("PositionMin", -10.0);
    joint.set("PositionMax", 10.0);
    joint.set("MaxVelocity", 2.0);
    joint.set("MaxAcceleration", 100.0);
    joint.set(names_of(kWay).limit, 12.0);
    joint.set("Period", 0.001);
    joint.set("HomingMethod", std::string("switch"));
    joint.set("HomingVelocity", -0.5);
    joint.set("HomingTravel", 0.5);
    if (is_effort(kWay)) joint.set("HomingEffort", 10.0);
    if (is_effort(kWay)) joint.set("HomingStiffness", 1000.0);
    for (const char* name : {"actuatorOff", "brakeApply", "sensorRead"}) {
      joint.serve<bool()>(name, [] { return true; });
    }
    for (const char* name : {"actuatorOn", "brakeRelease", "positionFound"}) {
      joint.serve<bool(control::DrivePermit)>(name, [](control::DrivePermit) { return true; });
    }
    joint.serve<bool(control::DrivePermit, double)>("beginHoming",
                                                    [](auto, double) { return true; });
    joint.write(names_of(kWay).command, 0.0);
    component::Host::assign_context(arming, component::Host::context(joint.component()));
    EXPECT_TRUE(component::Host::configure(arming));
    EXPECT_TRUE(component::Host::start(arming));
    for (auto* handler : component::interface_of(joint.component()).handlers) {
      if (handler->name() == "Arm") arming.connect(*handler);
    }
  }
  void cycle() {
    joint.run_cycles();
    joint.write(names_of(kWay).command, 0.5);  // is ignored
    joint.raise("Sample");
    const double told = drives();
    way += told;
    joint.write("IndexSensor", switch_works && way < -0.05);
    joint.write("DisplacementSensor", told);
  }
  CommandStage home() {
    const auto command = joint.send<>("home");
    for (int k = 0; k < 10'000 && !command.ended(); ++k) cycle();
    reason = command.reason();
    return command.stage();
  }

  Arms arming;
  testing::Harness joint{std::make_unique<JointOf<kWay>>("Joint1")};
  double way = 0.0;
  bool switch_works = true;
  std::string reason;

 private:
  double drives() {
    if constexpr (kWay == JointCommand::kVelocity) {
      return joint.output<control::LimitedVelocity>("VelocityActuator") * 0.001;
    } else {
      return joint.output<control::LimitedEffort>("TorqueActuator") * 0.0005;
    }
  }
};

template <JointCommand kWay>
void expect_homing() {
  HomedJoint<kWay> homed;
  ASSERT_TRUE(homed.joint.start()) << homed.joint.reason();
  homed.cycle();
  const testing::RealtimeGuard
      guard;  // as expect_realtime_on_bench, "OwnHoming" and "JointPeer", but fewer times
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(homed.home(), CommandStage::kDone) << homed.reason;
    homed.cycle();
  }
  homed.switch_works = false;
  EXPECT_EQ(homed.home(), CommandStage::kFailed);
  EXPECT_EQ(guard.violations(), 0u) << guard.report();
}

TEST(RealtimeComponents, JointThatHomesByVelocity) { expect_homing<JointCommand::kVelocity>(); }
TEST(RealtimeComponents, JointThatHomesByTorque) { expect_homing<JointCommand::kTorque>(); }

}  // namespace
}  // namespace armature::controllers
