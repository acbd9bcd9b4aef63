// SPDX-License-Identifier: Apache-2.0
#include "armature/control/dynamics/inverse_dynamics.hpp"

#include <algorithm>
#include <utility>

#include <kdl/chainidsolver_recursive_newton_euler.hpp>

#include "armature/control/internal/urdf_chain.hpp"

namespace armature::control {

struct InverseDynamics::Solver {
  Solver(internal::UrdfChain&& read, const std::array<double, 3>& gravity)
      : chain(std::move(read)),
        newton_euler(chain.segments, {gravity[0], gravity[1], gravity[2]}),
        weightless(chain.segments, KDL::Vector::Zero()),
        positions(chain.segments.getNrOfJoints()),
        velocities(chain.segments.getNrOfJoints()),
        accelerations(chain.segments.getNrOfJoints()),
        torques(chain.segments.getNrOfJoints()),
        no_forces(chain.segments.getNrOfSegments(), KDL::Wrench::Zero()) {}
  Solver(const Solver&) = delete;  // the algorithm refers to the chain
  Solver& operator=(const Solver&) = delete;

  void rest_at(std::span<const double> wanted) {
    std::copy(wanted.begin(), wanted.end(), positions.data.data());
    velocities.data.setZero();
    accelerations.data.setZero();
  }

  const internal::UrdfChain chain;
  KDL::ChainIdSolver_RNE newton_euler;
  KDL::ChainIdSolver_RNE weightless;
  KDL::JntArray positions;
  KDL::JntArray velocities;
  KDL::JntArray accelerations;
  KDL::JntArray torques;
  const KDL::Wrenches no_forces;
};

std::optional<InverseDynamics> InverseDynamics::load(const std::string& file, const Config& config,
                                                     base::Diagnostics& diagnostics) {
  const auto text = internal::read_description(file, diagnostics);
  if (!text) return std::nullopt;
  return parse(*text, file, config, diagnostics);
}

std::optional<InverseDynamics> InverseDynamics::parse(const std::string& text,
                                                      const std::string& file, const Config& config,
                                                      base::Diagnostics& diagnostics) {
  auto chain = internal::read_urdf(text, {file, config.base_link, config.tip_link}, diagnostics);
  if (!chain) return std::nullopt;
  return InverseDynamics(std::make_unique<Solver>(std::move(*chain), config.gravity));
}

InverseDynamics::InverseDynamics(std::unique_ptr<Solver> solver) : solver_(std::move(solver)) {}
InverseDynamics::InverseDynamics(InverseDynamics&&) noexcept = default;
InverseDynamics& InverseDynamics::operator=(InverseDynamics&&) noexcept = default;
InverseDynamics::~InverseDynamics() = default;

bool InverseDynamics::step(std::span<const double> motion, std::span<double> torques) {
  const std::size_t count = joints();
  if (motion.size() != 3 * count || torques.size() != count) return false;
  Solver& solver = *solver_;
  std::copy_n(motion.data(), count, solver.positions.data.data());
  std::copy_n(motion.data() + count, count, solver.velocities.data.data());
  std::copy_n(motion.data() + 2 * count, count, solver.accelerations.data.data());
  solver.newton_euler.CartToJnt(solver.positions, solver.velocities, solver.accelerations,
                                solver.no_forces, solver.torques);
  std::copy_n(solver.torques.data.data(), count, torques.data());
  return true;
}

bool InverseDynamics::gravity(std::span<const double> positions, std::span<double> torques) {
  const std::size_t count = joints();
  if (positions.size() != count || torques.size() != count) return false;
  Solver& solver = *solver_;
  solver.rest_at(positions);
  solver.newton_euler.CartToJnt(solver.positions, solver.velocities, solver.accelerations,
                                solver.no_forces, solver.torques);
  std::copy_n(solver.torques.data.data(), count, torques.data());
  return true;
}

/// A column is what a unit of acceleration of one joint needs.
bool InverseDynamics::mass_matrix(std::span<const double> positions, std::span<double> matrix) {
  const std::size_t count = joints();
  if (positions.size() != count || matrix.size() != count * count) return false;
  Solver& solver = *solver_;
  solver.rest_at(positions);
  for (std::size_t column = 0; column < count; ++column) {
    double& acceleration = solver.accelerations.data[static_cast<Eigen::Index>(column)];
    acceleration = 1.0;
    solver.weightless.CartToJnt(solver.positions, solver.velocities, solver.accelerations,
                                solver.no_forces, solver.torques);
    acceleration = 0.0;
    for (std::size_t row = 0; row < count; ++row) {
      matrix[row * count + column] = solver.torques.data[static_cast<Eigen::Index>(row)];
    }
  }
  return true;
}

std::size_t InverseDynamics::joints() const { return solver_->chain.joints.size(); }

const std::vector<std::string>& InverseDynamics::joint_names() const {
  return solver_->chain.joints;
}

const std::vector<JointLimits>& InverseDynamics::limits() const { return solver_->chain.limits; }

}  // namespace armature::control
