// SPDX-License-Identifier: Apache-2.0
// A drive as one buys it today: it takes torques, velocities or positions, and knows where its axis
// is. Here the drive, its brake, and a link that hangs on it are simulated in place of the calls to
// a real one.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "armature/component/registry.hpp"
#include "armature/controllers/base/joint_hardware.hpp"
#include "armature/controllers/base/sampling_period.hpp"

namespace drive {

using namespace armature::component;
using armature::control::LimitedEffort;
using armature::control::LimitedPosition;
using armature::control::LimitedVelocity;
using armature::controllers::JointCommand;

/// The deployment connects one of its inputs TorqueActuator, VelocityActuator, PositionActuator to
/// a joint of that kind: `commanded()` says which. A real drive is switched to that mode in
/// actuator_on, while it rests.
class Drive final : public armature::controllers::JointHardware {
 public:
  explicit Drive(std::string name)
      : JointHardware(std::move(name),
                      {JointCommand::kTorque, JointCommand::kVelocity, JointCommand::kPosition},
                      Sensor::kAbsolute) {}

 private:
  bool actuator_on() override {
    on_ = true;
    torque_ = velocity_ = held_ = 0.0;
    target_ = angle_;
    return true;  // false if the drive does not answer
  }
  bool actuator_off() override {
    on_ = false;
    return true;
  }
  bool actuator_set(LimitedEffort effort) override {
    torque_ = effort;
    return true;
  }
  bool velocity_set(LimitedVelocity velocity) override {
    velocity_ = velocity;
    return true;
  }
  bool position_set(LimitedPosition position) override {
    target_ = position;
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

  /// Once in each sampling period: what the axis did since the one before. The drive's own loops
  /// run ten times as often.
  bool sensor_read() override {
    const double step = period_.seconds() / kSteps;
    for (int k = 0; k < kSteps; ++k) {
      const double torque = on_ ? drive(step) : 0.0;
      const double weight = weight_ * std::cos(angle_);
      speed_ = braked_ ? 0.0 : speed_ + (torque - weight - kFriction * speed_) / kInertia * step;
      angle_ += speed_ * step;
    }
    sensor_.write(angle_);
    index_.write(false);
    return true;
  }

  /// [Nm]
  double drive(double step) {
    if (commanded() == JointCommand::kTorque) return torque_;
    const bool to_position = commanded() == JointCommand::kPosition;
    const double wanted = to_position ? kPosition * (target_ - angle_) : velocity_;
    held_ = std::clamp(held_ + kIntegral * (wanted - speed_) * step, -kMost, kMost);
    return std::clamp(kVelocity * (wanted - speed_) + held_, -kMost, kMost);
  }

  static constexpr int kSteps = 10;
  static constexpr double kInertia = 0.25;    // kg m^2
  static constexpr double kFriction = 0.1;    // Nm s/rad
  static constexpr double kPosition = 60.0;   // 1/s
  static constexpr double kVelocity = 50.0;   // Nm s/rad
  static constexpr double kIntegral = 800.0;  // Nm/rad
  static constexpr double kMost = 40.0;       // Nm

  armature::controllers::SamplingPeriod period_{this};
  Property<double> weight_{this, "Weight",
                           0.0,  "torque that holds the link where it is level",
                           "Nm", range(-20.0, 20.0)};

  bool on_ = false;
  bool braked_ = true;
  double torque_ = 0.0;
  double velocity_ = 0.0;
  double target_ = 0.0;
  double held_ = 0.0;
  double speed_ = 0.0;  // of the axis [rad/s]
  double angle_ = 0.0;
};

void add_counting_drive(armature::component::Registry& registry);  // counting_drive.cpp

}  // namespace drive

ARMATURE_COMPONENT_LIBRARY(drive, registry) {
  registry.add<drive::Drive>("Drive", "a drive with an absolute sensor",
                             armature::component::Granularity::kAtomic);
  drive::add_counting_drive(registry);
}
