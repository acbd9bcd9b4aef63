// SPDX-License-Identifier: Apache-2.0
// The simulated arm as sensor and actuator of a deployment, without its bus.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "armature/base/seconds.hpp"
#include "armature/component/author.hpp"
#include "armature/control/dynamics/inverse_dynamics.hpp"
#include "armature/control/transmission.hpp"
#include "armature/controllers/base/actuator.hpp"
#include "armature/controllers/base/sensor.hpp"
#include "robots/wam/emulator/arm_simulation.hpp"
#include "robots/wam/protocol/puck_torque.hpp"

namespace armature::wam {

inline const ArmNumbers& arm_of(int joints) { return joints == 4 ? wam4() : wam7(); }

// Of pucks, by the facts: what a motor is driven with at most, units of torque, counts of angle.
constexpr double kLargestTorque[] = {1.8, 1.8, 1.8, 1.6, 0.6, 0.6, 0.0916};  // [N m]
constexpr double kUnitsPerTorque[] = {2700, 2700, 2700, 2700, 6500, 6500, 17474};
constexpr double kCountsPerRad = 4096.0 / (2.0 * std::numbers::pi);

/// In the middle between two counts, as the driver takes it.
inline double rounded_angle(double angle) {
  return (std::floor(angle * kCountsPerRad) + 0.5) / kCountsPerRad;
}
/// What pucks drive the motors with, in their steps.
class PuckTorques {
 public:
  explicit PuckTorques(std::size_t motors) : torques_(motors) {}
  double step(std::size_t motor, double torque) {
    torques_[motor].set(torque * kUnitsPerTorque[motor]);
    return torques_[motor].next() / kUnitsPerTorque[motor];
  }

 private:
  std::vector<PuckTorque> torques_;
};

/// The arm and its encoders. With `rounds` it measures and drives in the steps of pucks, as the
/// driver does. A torque acts a millisecond after the Sample that it answers, as on a bus, and each
/// motor's is limited as its puck limits it. Braked until the first torques come.
class BenchArm final : public controllers::Sensor {
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
    motor_angles_.assign(count, 0.0);
    pucks_.emplace(count);
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
      motor_angles_[i] = rounds_ ? rounded_angle(arm_->angle(i)) : arm_->angle(i);
    }
    transmission_->joint_angles(motor_angles_, positions_);
    for (std::size_t i = 0; i < count; ++i) {
      measured_[count + i] = sampled_ ? positions_[i] - measured_[i] : 0.0;
      measured_[i] = positions_[i];
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
    transmission_->motor_torques(joint_torques_, motor_torques_);
    for (std::size_t i = 0; i < motor_torques_.size(); ++i) {
      const double torque = std::clamp(motor_torques_[i], -kLargestTorque[i], kLargestTorque[i]);
      if (torque != motor_torques_[i]) ++limited_;
      arm_->set_torque(i, rounds_ ? pucks_->step(i, torque) : torque);
    }
  }

  component::Property<std::string> urdf_{this, "robot_description", "", "file",
                                         "",   component::mandatory};
  component::Property<std::vector<double>> start_{this, "start", {}, "home, if none", "rad"};
  component::Property<bool> compensates_{this, "compensates_gravity", false, "as the WAM's driver"};
  component::Property<bool> rounds_{this, "rounds", false, "angles and torques as pucks do"};
  component::InputPort<std::vector<double>> torque_{this,
                                                    "torque",
                                                    "of each joint",
                                                    "Nm",
                                                    component::on_data<&BenchArm::on_torque>,
                                                    component::size_of(joints_),
                                                    component::leads_to_nothing()};
  std::optional<ArmSimulation> arm_;
  std::optional<control::Transmission> transmission_;
  std::optional<control::InverseDynamics> links_;
  std::optional<PuckTorques> pucks_;
  std::optional<base::Time> sampled_;
  bool driven_ = false;
  int limited_ = 0;
  std::vector<double> measured_, positions_, gravity_torques_, joint_torques_, motor_torques_;
  std::vector<double> motor_angles_;
};

/// Hands torques on to the arm.
class BenchActuator final : public controllers::Actuator {
 public:
  explicit BenchActuator(std::string name) : Actuator(std::move(name), "Nm") {}

 private:
  void actuate(const std::vector<double>& act) override { torque_.write(act); }

  component::OutputPort<std::vector<double>> torque_{this, "torque", "of each joint", "Nm",
                                                     component::size_of(joints_)};
};

}  // namespace armature::wam
