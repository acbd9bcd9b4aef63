// SPDX-License-Identifier: Apache-2.0
// The simulated arm as sensor and actuator of a deployment, without its bus.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "armature/base/seconds.hpp"
#include "armature/component/author.hpp"
#include "armature/control/inverse_dynamics.hpp"
#include "armature/control/transmission.hpp"
#include "armature/library/base/actuator.hpp"
#include "armature/library/base/sensor.hpp"
#include "robots/wam/arm_simulation.hpp"

namespace armature::wam {

inline const ArmNumbers& arm_of(int joints) { return joints == 4 ? wam4() : wam7(); }

/// The arm and its encoders. A torque acts a millisecond after the Sample that it answers, as on a
/// bus, and each motor's is limited as its puck limits it. Braked until the first torques come.
class BenchArm final : public library::Sensor {
 public:
  using Sensor::Sensor;
  static constexpr base::Duration kDelay = std::chrono::milliseconds(1);

  ArmSimulation& arm() { return *arm_; }
  /// How often a motor's torque was limited.
  int limited() const { return limited_; }

 private:
  component::Outcome on_configure() override {
    const ArmNumbers& numbers = arm_of(joints_);
    auto made = ArmSimulation::load(numbers, {.urdf_file = urdf_, .start = start_});
    if (!made) return component::refused(made.error());
    arm_.emplace(std::move(made).value());
    transmission_.emplace(control::Transmission::make(numbers.transmission).value());
    base::Diagnostics diagnostics;
    links_ = control::InverseDynamics::load(urdf_, {.gravity = {0.0, 0.0, -kGravity}}, diagnostics);
    const auto count = static_cast<std::size_t>(joints_.get());
    measured_.assign(2 * count, 0.0);
    positions_.assign(count, 0.0);
    gravity_torques_.assign(count, 0.0);
    joint_torques_.assign(count, 0.0);
    motor_torques_.assign(count, 0.0);
    return component::accepted();
  }
  component::Outcome on_start() override {
    sampled_ = std::nullopt;
    driven_ = false;
    return component::accepted();
  }
  void sample_now() override {
    const base::Duration past = sampled_ ? time() - *sampled_ : base::Duration{};
    if (past > kDelay) {
      arm_->advance(kDelay);
      apply();
      arm_->advance(past - kDelay);
    }
    const std::size_t count = positions_.size();
    for (std::size_t i = 0; i < count; ++i) {
      const double position = arm_->joint_position(i);
      measured_[count + i] = sampled_ ? position - positions_[i] : 0.0;
      measured_[i] = positions_[i] = position;
    }
    sampled_ = time();
    sensor_.write(measured_);
  }
  void on_torque(const std::vector<double>& torques) {
    joint_torques_ = torques;
    driven_ = true;
    if (!compensates_) return;
    links_->gravity(positions_, gravity_torques_);
    for (std::size_t i = 0; i < positions_.size(); ++i) joint_torques_[i] += gravity_torques_[i];
  }
  void apply() {
    if (!driven_) return;
    constexpr double kLargest[] = {1.8, 1.8, 1.8, 1.6, 0.6, 0.6, 0.0916};  // [N m]
    transmission_->motor_torques(joint_torques_, motor_torques_);
    for (std::size_t i = 0; i < motor_torques_.size(); ++i) {
      const double torque = std::clamp(motor_torques_[i], -kLargest[i], kLargest[i]);
      if (torque != motor_torques_[i]) ++limited_;
      arm_->set_torque(i, torque);
    }
  }

  component::Property<std::string> urdf_{this, "robot_description", "", "file",
                                         "",   component::mandatory};
  component::Property<std::vector<double>> start_{this, "start", {}, "home, if none", "rad"};
  component::Property<bool> compensates_{this, "compensates_gravity", false, "as the WAM's driver"};
  component::InputPort<std::vector<double>> torque_{this,
                                                    "torque",
                                                    "of each joint",
                                                    "V",
                                                    component::on_data<&BenchArm::on_torque>,
                                                    component::size_of(joints_),
                                                    component::leads_to_nothing()};
  std::optional<ArmSimulation> arm_;
  std::optional<control::Transmission> transmission_;
  std::optional<control::InverseDynamics> links_;
  std::optional<base::Time> sampled_;
  bool driven_ = false;
  int limited_ = 0;
  std::vector<double> measured_, positions_, gravity_torques_, joint_torques_, motor_torques_;
};

/// Hands torques on to the arm.
class BenchActuator final : public library::Actuator {
 public:
  using Actuator::Actuator;

 private:
  void actuate(const std::vector<double>& act) override { torque_.write(act); }

  component::OutputPort<std::vector<double>> torque_{this, "torque", "of each joint", "V",
                                                     component::size_of(joints_)};
};

}  // namespace armature::wam
