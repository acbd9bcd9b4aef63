// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"
#include "armature/sim/plant.hpp"
#include "armature/sim/pose.hpp"

namespace armature::sim {

/// Bodies that touch each other, such as a mobile robot on its floor: from MuJoCo's own description
/// (MJCF), with its contacts, friction and actuator-less joints; efforts in, motion out. For arms
/// on a base there is Plant, which takes a URDF.
///
/// Time passes in `step` alone, so two equal runs are equal to the bit.
///
/// Units are rad, N m and seconds (m and N at sliding joints). One thread uses it.
class World {
 public:
  /// How it is stepped; the time step of the description does not count.
  struct Options {
    /// Every `step` is made of whole steps of this length; > 0.
    base::Duration inner_step = std::chrono::milliseconds(1);
  };

  /// @param mjcf  the text of the description, without files beside it
  /// @param name  what errors call the text
  /// An error names the text, and what MuJoCo found.
  static base::Result<World> parse(const std::string& mjcf, const std::string& name,
                                   const Options& options);
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;
  ~World();

  /// Hinges and slides only: a free joint has no position of one number.
  std::optional<std::size_t> find_joint(std::string_view name) const;
  std::optional<std::size_t> find_body(std::string_view name) const;

  double position(std::size_t joint) const;
  double velocity(std::size_t joint) const;
  /// From now on; 0 at the beginning.
  /// @rt nonblocking, no allocation
  void set_effort(std::size_t joint, double effort);

  /// As the last inner step left it.
  /// @rt nonblocking, no allocation
  Pose pose(std::size_t body) const;
  /// Puts a body with a free joint somewhere, at rest: where a run begins, or what a hand does.
  /// @return false if the body has none
  /// @rt nonblocking, no allocation
  bool place(std::size_t body, const Pose& pose);

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
  explicit World(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace armature::sim
