// SPDX-License-Identifier: Apache-2.0
#include "armature/control/transmission.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <string>

namespace armature::control {
namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Vector = std::vector<double>;

base::Error error(const std::string& what) { return base::Error{"Transmission: " + what}; }

Matrix square(const Vector& turns, std::size_t joints) {
  const auto size = static_cast<Eigen::Index>(joints);
  if (turns.size() == joints * joints) return Eigen::Map<const Matrix>(turns.data(), size, size);
  return Eigen::Map<const Eigen::VectorXd>(turns.data(), size).asDiagonal();
}

Vector rows_of(const Matrix& matrix) { return {matrix.data(), matrix.data() + matrix.size()}; }

/// result = matrix vector
void multiply(const Vector& matrix, std::span<const double> vector, std::span<double> result) {
  const std::size_t size = result.size();
  for (std::size_t row = 0; row < size; ++row) {
    double sum = 0.0;
    for (std::size_t i = 0; i < size; ++i) sum += matrix[row * size + i] * vector[i];
    result[row] = sum;
  }
}

/// result = matrix' vector
void multiply_transposed(const Vector& matrix, std::span<const double> vector,
                         std::span<double> result) {
  const std::size_t size = result.size();
  for (std::size_t row = 0; row < size; ++row) {
    double sum = 0.0;
    for (std::size_t i = 0; i < size; ++i) sum += matrix[i * size + row] * vector[i];
    result[row] = sum;
  }
}

}  // namespace

base::Result<Transmission> Transmission::make(const Config& config) {
  const std::size_t joints = config.rotor_inertia.size();
  const auto sound = [](double number) { return std::isfinite(number) && number >= 0.0; };
  if (joints == 0) return error("rotor_inertia is empty, expected a number for each motor");
  if (!std::all_of(config.rotor_inertia.begin(), config.rotor_inertia.end(), sound)) {
    return error("rotor_inertia has a number that is not finite or below 0");
  }
  const Vector& friction = config.viscous_friction;
  if ((!friction.empty() && friction.size() != joints) ||
      !std::all_of(friction.begin(), friction.end(), sound)) {
    return error("viscous_friction is expected to be " + std::to_string(joints) +
                 " finite numbers of at least 0, or none");
  }
  if (config.turns.size() != joints && config.turns.size() != joints * joints) {
    return error("turns has " + std::to_string(config.turns.size()) + " numbers, expected " +
                 std::to_string(joints * joints) + ", a row of " + std::to_string(joints) +
                 " for each motor, or the " + std::to_string(joints) + " of the diagonal");
  }
  const Matrix turns = square(config.turns, joints);
  const Eigen::FullPivLU<Matrix> decomposition(turns);
  if (!turns.allFinite() || !decomposition.isInvertible()) {
    return error("turns has no inverse, expected motors that determine where all joints are");
  }
  const auto at_joints = [&turns](const Vector& motors) {
    const auto diagonal = Eigen::Map<const Eigen::VectorXd>(motors.data(), turns.rows());
    return rows_of(turns.transpose() * diagonal.asDiagonal() * turns);
  };
  Transmission made(joints);
  made.turns_ = rows_of(turns);
  made.inverse_ = rows_of(decomposition.inverse());
  made.rotors_ = at_joints(config.rotor_inertia);
  made.friction_ = at_joints(friction.empty() ? Vector(joints, 0.0) : friction);
  return made;
}

void Transmission::motor_angles(std::span<const double> joints, std::span<double> motors) const {
  multiply(turns_, joints, motors);
}

void Transmission::joint_angles(std::span<const double> motors, std::span<double> joints) const {
  multiply(inverse_, motors, joints);
}

void Transmission::motor_torques(std::span<const double> joints, std::span<double> motors) const {
  multiply_transposed(inverse_, joints, motors);
}

void Transmission::joint_torques(std::span<const double> motors, std::span<double> joints) const {
  multiply_transposed(turns_, motors, joints);
}

void Transmission::add_rotor_torques(std::span<const double> velocities,
                                     std::span<const double> accelerations,
                                     std::span<double> torques) const {
  for (std::size_t row = 0; row < joints_; ++row) {
    for (std::size_t i = 0; i < joints_; ++i) {
      const std::size_t entry = row * joints_ + i;
      torques[row] += rotors_[entry] * accelerations[i] + friction_[entry] * velocities[i];
    }
  }
}

}  // namespace armature::control
