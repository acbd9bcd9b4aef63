// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"

namespace armature::sim {

/// How the simulation stands.
enum class PlantStatus {
  kGood,
  kDiverged,  ///< a state would not be finite; it stays as it was, and no time passes any more
};

/// The rigid bodies of a robot on a fixed base, from a URDF file: efforts in, motion out. Joints
/// have the URDF's viscous and Coulomb friction, which holds at rest, and its position limits;
/// bodies do not collide, so the file needs no collision shapes.
///
/// Time passes in `step` alone, so two equal runs are equal to the bit.
///
/// Units are rad, N m and seconds (m and N at prismatic joints). One thread uses it.
class Plant {
 public:
  /// An entry of the inertia matrix that does not depend on where the joints are.
  struct Coupling {
    std::string first;  ///< joints of one chain, by their names
    std::string second;
    double inertia = 0.0;  ///< [kg m^2]
  };
  /// How the plant is stepped, and what the URDF does not say.
  struct Options {
    /// Every `step` is made of whole steps of this length; > 0.
    base::Duration inner_step = std::chrono::microseconds(100);
    /// What motors add to the inertia of their joints [kg m^2]; by the joint's name.
    std::map<std::string, double> armature;
    /// What motors add between two joints, as the unequal ones of a differential do.
    std::vector<Coupling> couplings{};
    std::array<double, 3> gravity{0.0, 0.0, -9.81};  ///< [m/s^2] in the axes of the root
  };

  /// @param file  a URDF file with moving joints of one degree of freedom, and without mimics
  /// An error names the file, and the joint or what MuJoCo found.
  static base::Result<Plant> load(const std::string& file, const Options& options);
  /// @param name  what errors call the text
  static base::Result<Plant> parse(const std::string& urdf, const std::string& name,
                                   const Options& options);
  Plant(Plant&&) noexcept;
  Plant& operator=(Plant&&) noexcept;
  ~Plant();

  /// The joints that move, in the order of the URDF's tree, depth first.
  std::size_t joints() const;
  std::string_view name(std::size_t joint) const;
  std::optional<std::size_t> find(std::string_view name) const;

  /// Its stops, lower and upper; none of a joint that turns on and on.
  std::optional<std::pair<double, double>> stops(std::size_t joint) const;

  double position(std::size_t joint) const;
  double velocity(std::size_t joint) const;

  /// Puts a joint somewhere: where a run begins.
  void set_state(std::size_t joint, double position, double velocity);
  /// The effort between the links from now on, besides friction and gravity; 0 at the beginning.
  /// @rt nonblocking, no allocation
  void set_effort(std::size_t joint, double effort);
  /// Presses a friction brake on the joint: what it holds at most, and brakes with if it slips; 0
  /// releases it.
  /// @rt nonblocking, no allocation
  void set_brake(std::size_t joint, double holding_effort);

  /// Lets time pass, in inner steps; what is left of one is made up for next time.
  /// @param dt  >= 0
  /// @rt nonblocking, no allocation
  PlantStatus step(base::Duration dt);

  PlantStatus status() const;
  /// The time that the inner steps until now have simulated.
  base::Duration time() const;
  base::Duration inner_step() const;

 private:
  struct Impl;
  explicit Plant(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace armature::sim
