// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/emulator/arm_simulation.hpp"

#include <fstream>
#include <iterator>
#include <utility>

namespace armature::wam {
namespace {

std::string joint_name(std::size_t index) { return "joint" + std::to_string(index + 1); }

sim::Plant::Options options_for(const control::Transmission& transmission,
                                const ArmSimulation::Config& config) {
  sim::Plant::Options options;
  options.inner_step = config.inner_step;
  options.gravity = {0.0, 0.0, -kGravity};
  for (std::size_t i = 0; i < transmission.joints(); ++i) {
    options.armature[joint_name(i)] = transmission.rotor_inertia(i, i);
    for (std::size_t j = 0; j < i; ++j) {
      const double inertia = transmission.rotor_inertia(i, j);
      if (inertia != 0.0) options.couplings.push_back({joint_name(j), joint_name(i), inertia});
    }
  }
  return options;
}

base::Result<void> check_sizes(const ArmNumbers& arm, const ArmSimulation::Config& config) {
  const auto mistake = [&](const char* name, const std::vector<double>& numbers) {
    if (numbers.empty() || numbers.size() == arm.joints()) return std::string();
    return std::string(name) + " has " + std::to_string(numbers.size()) + " numbers, expected " +
           std::to_string(arm.joints()) + ", one for each joint; ";
  };
  std::string mistakes =
      mistake("start", config.start) + mistake("coulomb_friction", config.coulomb_friction);
  if (mistakes.empty()) return {};
  mistakes.resize(mistakes.size() - 2);
  return base::Error{"ArmSimulation: " + mistakes};
}

base::Result<void> check_joints(const sim::Plant& plant, const ArmNumbers& arm,
                                const std::string& file) {
  bool same = plant.joints() == arm.joints();
  for (std::size_t i = 0; same && i < arm.joints(); ++i) same = plant.name(i) == joint_name(i);
  if (same) return {};
  return base::Error{file + ": expected the moving joints joint1 to " +
                     joint_name(arm.joints() - 1) + ", in this order"};
}

/// Where no arm can be it cannot begin.
base::Result<void> check_start(const sim::Plant& plant, const std::vector<double>& start) {
  constexpr double kGive = 0.05;  // [rad] home lies a little beyond
  for (std::size_t i = 0; i < start.size(); ++i) {
    const auto stops = plant.stops(i).value_or(std::pair{-1e3, 1e3});
    if (start[i] >= stops.first - kGive && start[i] <= stops.second + kGive) continue;
    return base::Error{"ArmSimulation: start has " + std::to_string(start[i]) + " rad for joint " +
                       std::to_string(i + 1) + ", expected from " + std::to_string(stops.first) +
                       " to " + std::to_string(stops.second)};
  }
  return {};
}

}  // namespace

base::Result<ArmSimulation> ArmSimulation::load(const ArmNumbers& arm, const Config& config) {
  std::ifstream stream(config.urdf_file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream.is_open() || stream.bad()) {
    return base::Error{config.urdf_file + ": cannot be read, expected a URDF file"};
  }
  return parse(arm, text, config);
}

base::Result<ArmSimulation> ArmSimulation::parse(const ArmNumbers& arm, const std::string& urdf,
                                                 const Config& config) {
  if (const auto checked = check_sizes(arm, config); !checked) return base::Error{checked.error()};
  auto transmission = control::Transmission::make(arm.transmission);
  if (!transmission) return base::Error{transmission.error()};
  auto plant = sim::Plant::parse(urdf, config.urdf_file, options_for(transmission.value(), config));
  if (!plant) return base::Error{plant.error()};
  if (const auto checked = check_joints(plant.value(), arm, config.urdf_file); !checked) {
    return base::Error{checked.error()};
  }
  if (const auto checked = check_start(plant.value(), config.start); !checked) {
    return base::Error{checked.error()};
  }
  ArmSimulation made(arm, config, std::move(transmission).value(), std::move(plant).value());
  made.set_state(config.start.empty() ? arm.home : config.start,
                 std::vector<double>(arm.joints(), 0.0));
  return made;
}

/// A winding that is shorted has the back-EMF drive a current through its resistance.
ArmSimulation::ArmSimulation(const ArmNumbers& arm, const Config& config,
                             control::Transmission transmission, sim::Plant plant)
    : transmission_(std::move(transmission)),
      plant_(std::move(plant)),
      motor_angles_(arm.joints()),
      motor_rates_(arm.joints()),
      motor_torques_(arm.joints()),
      joints_(arm.joints()) {
  const std::vector<double>& friction = arm.transmission.viscous_friction;
  for (std::size_t i = 0; i < arm.joints(); ++i) {
    const double k = arm.motors[i].torque_constant;
    motors_.push_back({.friction = config.motor_friction ? friction[i] : 0.0,
                       .braking = k * k / arm.motors[i].resistance_ohm});
  }
  for (std::size_t i = 0; i < config.coulomb_friction.size(); ++i) {
    plant_.set_brake(i, config.coulomb_friction[i]);
  }
}

sim::PlantStatus ArmSimulation::advance(base::Duration duration) {
  owed_ += duration;
  while (owed_ >= plant_.inner_step() && status() == sim::PlantStatus::kGood) {
    inner();
    owed_ -= plant_.inner_step();
  }
  return plant_.status();
}

/// The rates make the torques of brakes a matter of each inner step.
void ArmSimulation::inner() {
  for (std::size_t i = 0; i < motors_.size(); ++i) {
    const Motor& motor = motors_[i];
    const double driven = motor.braked ? -motor.braking * motor_rates_[i] : motor.torque;
    motor_torques_[i] = driven - motor.friction * motor_rates_[i];
  }
  transmission_.joint_torques(motor_torques_, joints_);
  for (std::size_t i = 0; i < joints_.size(); ++i) plant_.set_effort(i, joints_[i]);
  plant_.step(plant_.inner_step());
  look();
}

void ArmSimulation::look() {
  for (std::size_t i = 0; i < joints_.size(); ++i) joints_[i] = plant_.position(i);
  transmission_.motor_angles(joints_, motor_angles_);
  for (std::size_t i = 0; i < joints_.size(); ++i) joints_[i] = plant_.velocity(i);
  transmission_.motor_angles(joints_, motor_rates_);
}

void ArmSimulation::set_torque(std::size_t motor, double torque) {
  motors_[motor].torque = torque;
  motors_[motor].braked = false;
}

void ArmSimulation::brake(std::size_t motor) { motors_[motor].braked = true; }

void ArmSimulation::set_state(std::span<const double> positions,
                              std::span<const double> velocities) {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    plant_.set_state(i, positions[i], velocities[i]);
  }
  look();
}

}  // namespace armature::wam
