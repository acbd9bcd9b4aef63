// SPDX-License-Identifier: Apache-2.0
// The hardware of a joint: what you write for your own robot. Here a motor is simulated in place of
// the calls to a real drive.
#include <algorithm>
#include <cmath>

#include "armature/component/registry.hpp"
#include "armature/library/base/joint_hardware.hpp"

namespace servo {

using namespace armature::component;

/// One drive with its encoder. Framework and operator see to it that it is switched on only when
/// the operator arms, gets only what the joint's limiter let through, and is switched off whenever
/// something stops.
class Servo final : public armature::library::JointHardware {
 public:
  using JointHardware::JointHardware;

 private:
  bool actuator_on() override {
    on_ = true;
    return true;  // false if the drive does not answer
  }
  bool actuator_off() override {
    on_ = false;
    return true;
  }
  bool actuator_set(armature::control::LimitedEffort effort) override {
    voltage_ = effort;
    return true;
  }
  /// Once in each sampling period: what the axis did since the one before.
  bool sensor_read() override {
    const double wanted = on_ && !braked_ ? kSpeedPerVolt * voltage_ : 0.0;
    speed_ += std::min(1.0, period_ / kTimeConstant) * (wanted - speed_);
    const double displacement = speed_ * period_;
    angle_ += displacement;
    displacement_.write(displacement);
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

  static constexpr double kSpeedPerVolt = 20.0;  // rad/s/V
  static constexpr double kTimeConstant = 0.05;  // s
  static constexpr double kTurn = 6.283185307179586;

  Property<double> period_{this, "Period", 0.01, "between two samples", "s", range(1e-4, 1.0)};

  bool on_ = false;
  bool braked_ = true;
  double voltage_ = 0.0;
  double speed_ = 0.0;  // of the motor's axis [rad/s]
  double angle_ = 0.0;
};

}  // namespace servo

ARMATURE_COMPONENT_LIBRARY(servo, registry) {
  registry.add<servo::Servo>("Servo", "the drive of a joint");
}
