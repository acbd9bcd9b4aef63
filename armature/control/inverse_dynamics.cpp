// SPDX-License-Identifier: Apache-2.0
#include "armature/control/inverse_dynamics.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <utility>

#include <kdl/chainidsolver_recursive_newton_euler.hpp>

#include "armature/control/internal/urdf_chain.hpp"

namespace armature::control {

struct InverseDynamics::Solver {
  Solver(internal::UrdfChain&& read, const std::array<double, 3>& gravity)
      : chain(std::move(read)),
        newton_euler(chain.segments, {gravity[0], gravity[1], gravity[2]}),
        positions(chain.segments.getNrOfJoints()),
        velocities(chain.segments.getNrOfJoints()),
        accelerations(chain.segments.getNrOfJoints()),
        torques(chain.segments.getNrOfJoints()),
        no_forces(chain.segments.getNrOfSegments(), KDL::Wrench::Zero()) {}
  Solver(const Solver&) = delete;  // the algorithm refers to the chain
  Solver& operator=(const Solver&) = delete;

  const internal::UrdfChain chain;
  KDL::ChainIdSolver_RNE newton_euler;
  KDL::JntArray positions;
  KDL::JntArray velocities;
  KDL::JntArray accelerations;
  KDL::JntArray torques;
  const KDL::Wrenches no_forces;
};

std::optional<InverseDynamics> InverseDynamics::load(const std::string& file, const Config& config,
                                                     base::Diagnostics& diagnostics) {
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (stream.bad() || !stream.is_open()) {
    diagnostics.error({file}, "cannot be read, expected the description of a robot (URDF)",
                      "give the path of a file that exists");
    return std::nullopt;
  }
  return parse(text, file, config, diagnostics);
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

std::size_t InverseDynamics::joints() const { return solver_->chain.joints.size(); }

const std::vector<std::string>& InverseDynamics::joint_names() const {
  return solver_->chain.joints;
}

}  // namespace armature::control
