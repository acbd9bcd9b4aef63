// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "armature/controllers/base/controller.hpp"

namespace armature::controllers {

/// For N drives that follow velocities by themselves: of each joint the desired velocity, and `Kp`
/// times by how much its position is behind,
///
///     v = qd_desired + Kp (q_desired - q).
///
/// With a period T the joint swings from Kp = 1 / T on; a drive and a bus that answer later lower
/// that.
/// @rt nonblocking, no allocation, O(joints)
class ControllerNVelocity final : public Controller {
 public:
  explicit ControllerNVelocity(std::string name) : Controller(std::move(name), "rad/s") {}

 private:
  component::Outcome on_configure() override;
  component::Outcome on_start() override;
  void controller_now(const std::vector<double>& measured) override;
  component::Outcome take_gains();

  component::Property<std::vector<double>> kp_{
      this, "Kp", {}, "of each joint, or of all; 0: positions drift", "1/s", component::mandatory};
  std::vector<double> gains_;
  std::vector<double> velocities_;
};

}  // namespace armature::controllers
