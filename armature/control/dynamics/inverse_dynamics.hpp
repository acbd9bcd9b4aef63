// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/control/joint_limits.hpp"

namespace armature::control {

/// What moves a robot as wanted (paper 1, equation 1): torque = D(q) qdd + H(q, qd) + G(q), from
/// the description of its links and joints (URDF), by the recursive Newton-Euler algorithm.
///
/// Of rigid bodies: friction, rotors and gears are those of the actuator (DcMotor, Transmission).
/// One thread uses it.
class InverseDynamics {
 public:
  /// The chain from one link to another, and gravity.
  struct Config {
    std::string base_link{};  ///< the link that stands still; empty: the root
    std::string tip_link{};   ///< the end of the chain; empty: the only end there is
    /// [m/s^2] in the axes of base_link
    std::array<double, 3> gravity{0.0, 0.0, -9.81};
  };

  /// Reads a file, or a text of which `file` is the name in diagnostics. What is wrong is added to
  /// `diagnostics`: a file that cannot be read or is no URDF, links that do not exist, a chain that
  /// branches, joints that are floating or planar, bodies that cannot be.
  /// @return nothing after an error
  static std::optional<InverseDynamics> load(const std::string& file, const Config& config,
                                             base::Diagnostics& diagnostics);
  static std::optional<InverseDynamics> parse(const std::string& text, const std::string& file,
                                              const Config& config, base::Diagnostics& diagnostics);

  InverseDynamics(InverseDynamics&&) noexcept;
  InverseDynamics& operator=(InverseDynamics&&) noexcept;
  ~InverseDynamics();

  /// @param motion   [q, qd, qdd] of all joints, from the base on: rad, rad/s and rad/s^2 of joints
  ///                 that turn, m, m/s and m/s^2 of those that slide
  /// @param torques  [N m], [N] of joints that slide, one per joint; not finite if `motion` is not
  /// @return false, and nothing is computed, if one of them has another size
  /// @rt nonblocking, no allocation, O(joints)
  bool step(std::span<const double> motion, std::span<double> torques);

  /// G(q): what holds the links at rest.
  /// @param positions  [rad], [m] of joints that slide, one per joint
  /// @return false, and nothing is computed, if one of them has another size
  /// @rt nonblocking, no allocation, O(joints)
  bool gravity(std::span<const double> positions, std::span<double> torques);
  /// D(q), row by row: [kg m^2] of two joints that turn, [kg] of two that slide.
  /// @return false, and nothing is computed, if one of them has another size
  /// @rt nonblocking, no allocation, O(joints^2)
  bool mass_matrix(std::span<const double> positions, std::span<double> matrix);

  std::size_t joints() const;
  const std::vector<std::string>& joint_names() const;  ///< from the base on
  /// What the description allows each joint.
  const std::vector<JointLimits>& limits() const;

 private:
  struct Solver;
  explicit InverseDynamics(std::unique_ptr<Solver> solver);

  std::unique_ptr<Solver> solver_;
};

}  // namespace armature::control
