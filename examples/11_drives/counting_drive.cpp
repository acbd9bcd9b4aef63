// SPDX-License-Identifier: Apache-2.0
// A drive that cannot home: its encoder counts from where it was switched on. It tells of a home
// switch and of the encoder's index, and the joint finds its position by them. Drive, brake, link,
// switch and stops are simulated in place of the calls to a real one.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
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

class CountingDrive final : public armature::controllers::JointHardware {
 public:
  explicit CountingDrive(std::string name)
      : JointHardware(std::move(name),
                      {JointCommand::kVoltage, JointCommand::kTorque, JointCommand::kVelocity,
                       JointCommand::kPosition},
                      Sensor::kCounting) {}

  /// What a joint can find its position by.
  HomingSigns homing_signs() const override {
    return {.home_switch = true, .index_mark = true, .bounds_effort = true};
  }

 private:
  Outcome on_configure() override {
    angle_ = counted_from_ = begin_;
    return accepted();
  }
  bool actuator_on() override {
    on_ = true;
    effort_ = velocity_ = held_ = 0.0;
    target_ = counted();
    return true;  // false if the drive does not answer
  }
  bool actuator_off() override {
    on_ = false;
    return true;
  }
  bool actuator_set(LimitedEffort effort) override {
    effort_ = effort;
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
    braked_ = fails("brake");
    return true;
  }
  bool bound_effort(double most) override {
    most_ = std::min(most, kMost);
    return true;
  }
  double since_index() const override { return since_index_; }

  /// Once in each sampling period: what the axis did since the one before. The drive's own loops
  /// run ten times as often.
  bool sensor_read() override {
    const double step = period_.seconds() / kSteps;
    const double before = marks_below();
    for (int k = 0; k < kSteps; ++k) move(step);
    if (!fails("sensor")) shown_ = counted() + (fails("counter") ? kLost : 0.0);
    const double mark = kMark + kPitch * std::max(before, marks_below());
    const bool passed = before != marks_below() && !fails("index");
    since_index_ = passed ? angle_ - mark : std::numeric_limits<double>::quiet_NaN();
    really_.assign(angle_);
    index_.write(fails("switch_closed") || (angle_ < kSwitch && !fails("switch_open")));
    sensor_.write(shown_);
    return true;
  }

  void move(double step) {
    const double torque = (on_ ? drive(step) : 0.0) - weight_ * std::cos(angle_);
    speed_ = braked_ ? 0.0 : speed_ + (torque - kFriction * speed_) / kInertia * step;
    angle_ += speed_ * step;
    if (std::abs(angle_) <= stop_) return;
    if (fails("stop") && std::abs(torque) > kSlips) {
      speed_ = std::clamp(speed_, -kSlipping, kSlipping);
      stop_ = std::abs(angle_);
      return;
    }
    angle_ = std::copysign(stop_, angle_);
    speed_ = 0.0;
  }

  /// [Nm]
  double drive(double step) {
    if (commanded() == JointCommand::kTorque) return effort_;
    if (commanded() == JointCommand::kVoltage) return kPerVolt * (effort_ - kBackEmf * speed_);
    const bool to_position = commanded() == JointCommand::kPosition;
    const double wanted = to_position ? kPosition * (target_ - shown_) : velocity_;
    held_ = std::clamp(held_ + kIntegral * (wanted - speed_) * step, -most_, most_);
    return std::clamp(kVelocity * (wanted - speed_) + held_, -most_, most_);
  }

  double counted() const { return std::round((angle_ - counted_from_) / kCount) * kCount; }
  double marks_below() const { return std::floor((angle_ - kMark) / kPitch); }
  bool fails(std::string_view what) const { return fails_.get() == what; }

  static constexpr int kSteps = 10;
  static constexpr double kInertia = 0.25;    // kg m^2
  static constexpr double kFriction = 0.1;    // Nm s/rad
  static constexpr double kPerVolt = 2.0;     // Nm/V
  static constexpr double kBackEmf = 2.0;     // V s/rad
  static constexpr double kPosition = 60.0;   // 1/s
  static constexpr double kVelocity = 50.0;   // Nm s/rad
  static constexpr double kIntegral = 800.0;  // Nm/rad
  static constexpr double kMost = 40.0;       // Nm
  static constexpr double kCount = 1e-4;      // rad
  static constexpr double kLost = 0.5;        // rad; by a counter that is out of order
  static constexpr double kStop = 1.6;        // rad
  static constexpr double kSwitch = -1.2;     // rad; closed below
  static constexpr double kMark = -1.1;       // rad; an index of the encoder, and each kPitch
  static constexpr double kPitch = 0.4;       // rad
  static constexpr double kSlips = 0.5;       // Nm
  static constexpr double kSlipping = 0.15;   // rad/s

  armature::controllers::SamplingPeriod period_{this};
  Property<double> weight_{this, "Weight",
                           0.0,  "torque that holds the link where it is level",
                           "Nm", range(-20.0, 20.0)};
  Property<double> begin_{this, "Begin", 0.0, "where it stands at first", "rad", range(-1.6, 1.6)};
  Property<std::string> fails_{this,
                               "Fails",
                               "",
                               "what is out of order: switch_open, switch_closed, index, sensor, "
                               "counter, brake, stop (slips)",
                               "",
                               changeable_while_running};
  Attribute<double> really_{this, "angle", 0.0, "where it really is", "rad"};

  bool on_ = false;
  bool braked_ = true;
  double effort_ = 0.0;
  double velocity_ = 0.0;
  double target_ = 0.0;
  double held_ = 0.0;
  double most_ = kMost;
  double speed_ = 0.0;  // of the axis [rad/s]
  double angle_ = 0.0;
  double stop_ = kStop;
  double counted_from_ = 0.0;
  double shown_ = 0.0;
  double since_index_ = std::numeric_limits<double>::quiet_NaN();
};

/// Of this file, for the library that has both drives.
void add_counting_drive(armature::component::Registry& registry) {
  registry.add<CountingDrive>("CountingDrive", "a drive whose encoder begins anywhere",
                              armature::component::Granularity::kAtomic);
}

}  // namespace drive
