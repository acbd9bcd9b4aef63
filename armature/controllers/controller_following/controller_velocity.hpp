// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "armature/controllers/base/checked_gains.hpp"
#include "armature/controllers/base/controller.hpp"

namespace armature::controllers {

/// For N drives that follow velocities by themselves: of each joint the desired velocity, and `Kp`
/// times by how much its position is behind,
///
///     v = qd_desired + Kp (q_desired - q).
///
/// A joint swings if it answers late: Kp (T + d) may be 0.5 at most, which leaves its loop a phase
/// margin of 61 degrees, with the sampling period T and the Robot's effort_delay d. The check
/// refuses more, and so does the property.
/// @rt nonblocking, no allocation, O(joints)
class ControllerNVelocity final : public Controller {
 public:
  explicit ControllerNVelocity(std::string name) : Controller(std::move(name), "rad/s") {}

 private:
  component::Outcome on_configure() override;
  component::Outcome on_start() override;
  void controller_now(const std::vector<double>& measured) override;
  component::Outcome take_gains();
  std::vector<DrivenJoint> followers(const component::Check& check) const;
  std::string objection_to_kp(const std::vector<DrivenJoint>& joints, double period_s,
                              const std::vector<double>& kp) const;

  component::Property<std::vector<double>> kp_{
      this, "Kp", {}, "of each joint, or of all; 0: positions drift", "1/s", component::mandatory};
  CheckedGains checked_gains_{this,
                              [this](const component::Check& check) { return followers(check); },
                              [this](const std::vector<DrivenJoint>& joints, double period_s,
                                     const CheckedGains::Wanted& wanted) {
                                return objection_to_kp(joints, period_s, wanted.value_of(kp_));
                              },
                              kp_};
  std::vector<double> gains_;
  std::vector<double> velocities_;
};

}  // namespace armature::controllers
