// SPDX-License-Identifier: Apache-2.0
#include "armature/control/cartesian/inverse_kinematics.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <utility>

#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainjnttojacsolver.hpp>

#include "armature/control/internal/urdf_chain.hpp"

namespace armature::control {
namespace {

using Twist = Eigen::Matrix<double, 6, 1>;

constexpr int kMostNewtonSteps = 50;
constexpr double kSolved = 1e-9;
constexpr double kNewtonDamping = 1e-6;  // of squares: far below what a usable arm has

KDL::Frame frame_of(const Pose& pose) {
  const auto& r = pose.rotation;
  return {KDL::Rotation(r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8]),
          KDL::Vector(pose.position[0], pose.position[1], pose.position[2])};
}

}  // namespace

struct InverseKinematics::Solver {
  explicit Solver(internal::UrdfChain&& read)
      : chain(std::move(read)),
        forward(chain.segments),
        slopes(chain.segments),
        positions(chain.segments.getNrOfJoints()),
        jacobian(chain.segments.getNrOfJoints()) {}
  Solver(const Solver&) = delete;  // the algorithms refer to the chain
  Solver& operator=(const Solver&) = delete;

  KDL::Frame end() {
    KDL::Frame last;
    forward.JntToCart(positions, last);
    return last * chain.tip;
  }
  /// The jacobian's reference is the end of the last segment.
  void find_slopes(const KDL::Frame& tip) {
    KDL::Frame last;
    forward.JntToCart(positions, last);
    slopes.JntToJac(positions, jacobian);
    jacobian.changeRefPoint(tip.p - last.p);
  }

  const internal::UrdfChain chain;
  KDL::ChainFkSolverPos_recursive forward;
  KDL::ChainJntToJacSolver slopes;
  KDL::JntArray positions;
  KDL::Jacobian jacobian;
};

std::optional<InverseKinematics> InverseKinematics::load(const std::string& file,
                                                         const Config& config,
                                                         base::Diagnostics& diagnostics) {
  const auto text = internal::read_description(file, diagnostics);
  if (!text) return std::nullopt;
  auto chain = internal::read_urdf(*text, {file, config.base_link, config.tip_link}, diagnostics);
  if (!chain) return std::nullopt;
  return InverseKinematics(std::make_unique<Solver>(std::move(*chain)));
}

InverseKinematics::InverseKinematics(std::unique_ptr<Solver> solver) : solver_(std::move(solver)) {}
InverseKinematics::InverseKinematics(InverseKinematics&&) noexcept = default;
InverseKinematics& InverseKinematics::operator=(InverseKinematics&&) noexcept = default;
InverseKinematics::~InverseKinematics() = default;

std::size_t InverseKinematics::joints() const { return solver_->chain.joints.size(); }
const std::vector<std::string>& InverseKinematics::joint_names() const {
  return solver_->chain.joints;
}
const std::vector<JointLimits>& InverseKinematics::limits() const { return solver_->chain.limits; }

Pose InverseKinematics::pose_at(std::span<const double> positions) {
  std::copy(positions.begin(), positions.end(), solver_->positions.data.data());
  const KDL::Frame end = solver_->end();
  Pose pose;
  std::copy_n(end.p.data, pose.position.size(), pose.position.begin());
  std::copy_n(end.M.data, pose.rotation.size(), pose.rotation.begin());
  return pose;
}

double InverseKinematics::solve(const Pose& pose, std::span<double> positions) {
  Solver& solver = *solver_;
  const KDL::Frame wanted = frame_of(pose);
  std::copy(positions.begin(), positions.end(), solver.positions.data.data());
  double left = 0.0;
  for (int step = 0; step <= kMostNewtonSteps; ++step) {
    const KDL::Frame end = solver.end();
    const KDL::Twist apart = KDL::diff(end, wanted);
    Twist error;
    error << apart.vel[0], apart.vel[1], apart.vel[2], apart.rot[0], apart.rot[1], apart.rot[2];
    left = error.norm();
    if (left < kSolved || step == kMostNewtonSteps) break;
    solver.find_slopes(end);
    const auto& j = solver.jacobian.data;
    const Eigen::Matrix<double, 6, 6> squares =
        j * j.transpose() + kNewtonDamping * Eigen::Matrix<double, 6, 6>::Identity();
    solver.positions.data += j.transpose() * squares.ldlt().solve(error);
  }
  std::copy_n(solver.positions.data.data(), positions.size(), positions.begin());
  return left;
}

}  // namespace armature::control
