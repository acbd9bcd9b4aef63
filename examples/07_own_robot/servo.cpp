// SPDX-License-Identifier: Apache-2.0
// The hardware of a joint: what you write for your own robot. Here a motor, its brake and the
// weight of what hangs on it are simulated in place of the calls to a real drive.
#include <cmath>

#include "armature/component/registry.hpp"
#include "armature/controllers/base/joint_hardware.hpp"
#include "armature/controllers/base/sampling_period.hpp"

namespace servo {

using namespace armature::component;

/// One drive with its encoder. Framework and operator see to it that it is switched on only when
/// the operator arms, gets only what the joint's limiter let through, and is switched off whenever
/// something stops.
class Servo final : public armature::controllers::JointHardware {
 public:
  using JointHardware::JointHardware;

 private:
  bool actuator_on() override {
    switch_to(true);
    return true;  // false if the drive does not answer
  }
  bool actuator_off() override {
    switch_to(false);
    return true;
  }
  bool actuator_set(armature::control::LimitedEffort effort) override {
    voltage_ = effort;
    return true;
  }
  /// Once in each sampling period: what the axis did since the one before.
  bool sensor_read() override {
    speed_ = braked_ ? 0.0 : speed_ + acceleration() * period_;
    const double displacement = speed_ * period_;
    angle_ += displacement;
    sensor_.write(displacement);
    index_.write(std::abs(std::remainder(angle_, kTurn)) < 0.05);
    return true;
  }
  bool brake_apply() override {
    braked_ = true;
    return true;
  }
  bool brake_release() override {
    braked_ = false;
    return true;
  }

  void switch_to(bool on) {
    on_ = on;
    shown_on_.assign(on);
  }

  /// A motor that is on resists by its own voltage; one that is off falls freely.
  double acceleration() const {
    const double weight = weight_ * std::cos(angle_ * kGearRatio);
    const double driven = on_ ? voltage_ - speed_ / kSpeedPerVolt : 0.0;
    return (driven - weight) * kSpeedPerVolt / kTimeConstant;
  }

  static constexpr double kSpeedPerVolt = 20.0;  // rad/s/V
  static constexpr double kTimeConstant = 0.05;  // s
  static constexpr double kGearRatio = 0.01;     // of the joint's angle
  static constexpr double kTurn = 6.283185307179586;

  armature::controllers::SamplingPeriod period_{this};
  Property<double> weight_{this, "Weight",
                           0.0,  "voltage that holds the joint where it is level",
                           "V",  range(-12.0, 12.0)};
  Attribute<bool> shown_on_{this, "on", false, "the motor is switched on"};

  bool on_ = false;
  bool braked_ = true;
  double voltage_ = 0.0;
  double speed_ = 0.0;  // of the motor's axis [rad/s]
  double angle_ = 0.0;
};

}  // namespace servo

ARMATURE_COMPONENT_LIBRARY(servo, registry) {
  registry.add<servo::Servo>("Servo", "the drive of a joint",
                             armature::component::Granularity::kAtomic);
}
