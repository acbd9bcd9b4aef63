// SPDX-License-Identifier: Apache-2.0
// What the models of the library `robot` have in common: their period, their samples, their
// hardware.
#include <chrono>
#include <initializer_list>
#include <memory>
#include <optional>

#include "armature/component/host.hpp"
#include "armature/controllers/base/held_jog.hpp"
#include "armature/controllers/base/joint_hardware.hpp"
#include "armature/controllers/base/sample_watch.hpp"
#include "armature/controllers/base/sampling_period.hpp"
#include "armature/testing/harness.hpp"
#include "tests/realtime/expect_realtime.hpp"

namespace armature::controllers {
namespace {

using namespace std::chrono_literals;

TEST(RealtimeFunctions, AJogThatIsHeld) {
  HeldJog jog;
  bool renewed = false;
  bool let_go = false;
  expect_realtime("HeldJog", [&] {
    jog.begin(1, 0.5, base::Time(1s));
    renewed = jog.renew(1, 0.5, base::Time(1100ms));
    let_go = jog.let_go(base::Time(1250ms));
  });
  EXPECT_TRUE(renewed);
  EXPECT_TRUE(let_go);
}

class Sampled final : public component::Component {
 public:
  using Component::Component;
  SamplingPeriod period{this};
};

TEST(RealtimeFunctions, SamplingPeriodOfThePlanOrTheProperty) {
  Sampled sampled("Joint");
  const component::Component owner("Sampler");
  base::Duration duration{};
  bool known = false;
  const auto look = [&] {
    expect_realtime("SamplingPeriod::duration", [&] { duration = sampled.period.duration(); });
    expect_realtime("SamplingPeriod::known",
                    [&] { known = static_cast<bool>(sampled.period.known()); });
  };
  look();
  EXPECT_FALSE(known);
  EXPECT_TRUE(sampled.period.property().set(types::Value::of(0.01)));
  look();
  EXPECT_EQ(duration, 10ms);
  EXPECT_TRUE(known);
  component::Host::set_pace(sampled, {.period = 2ms, .owner = &owner});
  look();
  EXPECT_EQ(duration, 2ms);
  EXPECT_FALSE(known) << "they differ";
}

TEST(RealtimeFunctions, SampleWatchOfRightAndWrongSamples) {
  component::ExecutionContext context("test");
  component::Component sampled("Joint");
  component::Host::assign_context(sampled, context);
  base::Time now = base::time_from_ns(0);
  std::optional<component::Reason> wrong;
  for (const base::Duration interval : {10ms, 15ms}) {
    SampleWatch watch;
    watch.begin(10ms);
    expect_realtime("SampleWatch::sample", [&] {
      context.cycle_time = now += interval;
      wrong = watch.sample(sampled);
    });
    EXPECT_EQ(wrong.has_value(), interval != 10ms);
  }
}

TEST(RealtimeFunctions, SampleWatchInTheThreadOfThePeriod) {
  component::ExecutionContext context("test");
  context.period = 10ms;
  component::Component sampled("Joint");
  component::Host::assign_context(sampled, context);
  component::Host::set_pace(sampled, {.period = 10ms, .owner = &sampled});
  SampleWatch watch;
  watch.begin(10ms);
  std::optional<component::Reason> wrong;
  expect_realtime("SampleWatch::sample", [&] {
    ++context.cycle;
    wrong = watch.sample(sampled);
  });
  EXPECT_FALSE(wrong);
  expect_realtime("SampleWatch::sample", [&] { wrong = watch.sample(sampled); });
  EXPECT_TRUE(wrong) << "again in the same cycle";
}

/// Takes everything, and may lose a sample.
class Motor final : public JointHardware {
 public:
  using JointHardware::commanded;
  using JointHardware::JointHardware;
  using JointHardware::lose_position;

 private:
  bool actuator_on() override { return true; }
  bool actuator_off() override { return true; }
  bool actuator_set(control::LimitedEffort) override { return true; }
  bool sensor_read() override { return true; }
  bool brake_apply() override { return true; }
  bool brake_release() override { return true; }
};

TEST(RealtimeFunctions, JointHardwareThatLosesASample) {
  testing::Harness bench(std::make_unique<Motor>("Motor"));
  auto& motor = static_cast<Motor&>(bench.component());
  ASSERT_TRUE(bench.start()) << bench.reason();
  EXPECT_TRUE(bench.call<bool>("positionKnown").value());
  bench.set("position_confirmed", true);
  expect_realtime("JointHardware::lose_position", [&] { motor.lose_position(); });
  EXPECT_FALSE(bench.get<bool>("position_confirmed")) << "that was said before it was lost";
  EXPECT_FALSE(bench.call<bool>("positionKnown").value());
  bench.set("position_confirmed", true);
  EXPECT_TRUE(bench.call<bool>("positionKnown").value());
}

TEST(RealtimeFunctions, JointHardwareThatIsTorquesAmongOthers) {
  using enum JointCommand;
  testing::Harness bench(
      std::make_unique<Motor>("Motor", std::initializer_list<JointCommand>{kVelocity, kTorque},
                              JointHardware::Sensor::kAbsolute));
  auto& motor = static_cast<Motor&>(bench.component());
  EXPECT_EQ(motor.commanded(), kVelocity) << "before it is connected";
  bench.write("TorqueActuator", control::LimitedEffort());
  JointCommand commanded = kVelocity;
  expect_realtime("JointHardware::commanded", [&] { commanded = motor.commanded(); });
  EXPECT_EQ(commanded, kTorque);
}

}  // namespace
}  // namespace armature::controllers
