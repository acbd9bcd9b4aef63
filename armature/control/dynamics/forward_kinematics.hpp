// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "armature/base/diagnostic.hpp"

namespace armature::control {

/// Where a link is and how it is turned, in the axes of another.
struct Pose {
  std::array<double, 3> position{};                           ///< [m]
  std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< row by row: v_base = R v_link
};

/// Where the end of a robot is, by the description of its links and joints (URDF). One thread uses
/// it.
class ForwardKinematics {
 public:
  /// The chain from one link to another.
  struct Config {
    std::string base_link{};  ///< in whose axes poses are; empty: the root
    std::string tip_link{};   ///< whose pose it is; empty: the link of the last joint that moves
  };

  /// Reads a file, or a text of which `file` is the name in diagnostics; what is wrong is added to
  /// `diagnostics`, as by InverseDynamics.
  /// @return nothing after an error
  static std::optional<ForwardKinematics> load(const std::string& file, const Config& config,
                                               base::Diagnostics& diagnostics);
  static std::optional<ForwardKinematics> parse(const std::string& text, const std::string& file,
                                                const Config& config,
                                                base::Diagnostics& diagnostics);

  ForwardKinematics(ForwardKinematics&&) noexcept;
  ForwardKinematics& operator=(ForwardKinematics&&) noexcept;
  ~ForwardKinematics();

  /// @param positions  of all joints, from the base on: rad, m of joints that slide
  /// @return false, and `pose` is as it was, if there are not as many as joints
  /// @rt nonblocking, no allocation, O(joints)
  bool step(std::span<const double> positions, Pose& pose);

  std::size_t joints() const;

 private:
  struct Solver;
  explicit ForwardKinematics(std::unique_ptr<Solver> solver);

  std::unique_ptr<Solver> solver_;
};

}  // namespace armature::control
