// SPDX-License-Identifier: Apache-2.0
#include "armature/control/dynamics/forward_kinematics.hpp"

#include <algorithm>
#include <utility>

#include <kdl/chainfksolverpos_recursive.hpp>

#include "armature/control/internal/urdf_chain.hpp"

namespace armature::control {

struct ForwardKinematics::Solver {
  explicit Solver(internal::UrdfChain&& read)
      : chain(std::move(read)),
        recursive(chain.segments),
        positions(chain.segments.getNrOfJoints()) {}
  Solver(const Solver&) = delete;  // the algorithm refers to the chain
  Solver& operator=(const Solver&) = delete;

  const internal::UrdfChain chain;
  KDL::ChainFkSolverPos_recursive recursive;
  KDL::JntArray positions;
};

std::optional<ForwardKinematics> ForwardKinematics::load(const std::string& file,
                                                         const Config& config,
                                                         base::Diagnostics& diagnostics) {
  const auto text = internal::read_description(file, diagnostics);
  if (!text) return std::nullopt;
  return parse(*text, file, config, diagnostics);
}

std::optional<ForwardKinematics> ForwardKinematics::parse(const std::string& text,
                                                          const std::string& file,
                                                          const Config& config,
                                                          base::Diagnostics& diagnostics) {
  auto chain = internal::read_urdf(text, {file, config.base_link, config.tip_link}, diagnostics);
  if (!chain) return std::nullopt;
  return ForwardKinematics(std::make_unique<Solver>(std::move(*chain)));
}

ForwardKinematics::ForwardKinematics(std::unique_ptr<Solver> solver) : solver_(std::move(solver)) {}
ForwardKinematics::ForwardKinematics(ForwardKinematics&&) noexcept = default;
ForwardKinematics& ForwardKinematics::operator=(ForwardKinematics&&) noexcept = default;
ForwardKinematics::~ForwardKinematics() = default;

bool ForwardKinematics::step(std::span<const double> positions, Pose& pose) {
  if (positions.size() != joints()) return false;
  Solver& solver = *solver_;
  std::copy(positions.begin(), positions.end(), solver.positions.data.data());
  KDL::Frame last;
  solver.recursive.JntToCart(solver.positions, last);
  const KDL::Frame tip = last * solver.chain.tip;
  std::copy_n(tip.p.data, pose.position.size(), pose.position.begin());
  std::copy_n(tip.M.data, pose.rotation.size(), pose.rotation.begin());
  return true;
}

std::size_t ForwardKinematics::joints() const { return solver_->chain.joints.size(); }

}  // namespace armature::control
