// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "armature/controllers/base/controller.hpp"

namespace armature::wam {

/// The arm's own controller in the place of another Controller (paper 3, ControllerWAM and figure
/// 6): has WamHardware compute the torques, which knows the law and its gains; their way to the
/// arm is that of any other controller's. `posRefPort` takes posRef, or posVelRef with the
/// velocities of the reference. A torque that is no finite number is a fault.
/// @rt nonblocking, no allocation, O(joints)
class ControllerWam final : public controllers::Controller {
 public:
  explicit ControllerWam(std::string name) : Controller(std::move(name), "Nm") {}

 private:
  component::Outcome on_configure() override;
  component::Outcome on_start() override;
  void controller_now(const std::vector<double>& measured) override;
  void on_torques(const std::vector<double>& torques);

  component::OutputPort<std::vector<double>> position_reference_{
      this, "posRef", "positions for the arm's own controller", "rad", component::size_of(joints_)};
  component::OutputPort<std::vector<double>> motion_reference_{
      this, "posVelRef",
      "[q1..qN, qd1..qdN] for the arm's own controller, in the place of posRef: rad, rad/s", "rad",
      component::size_of(joints_, 2)};
  component::InputPort<std::vector<double>> control_data_{
      this,
      "ControlData",
      "torques of the arm's own controller",
      "Nm",
      component::on_data<&ControllerWam::on_torques>,
      component::size_of(joints_),
      component::leads_to("act")};
  std::vector<double> positions_;
  std::vector<double> motion_;  ///< [q, qd]
  bool asked_ = false;          ///< in this sampling period, and not answered yet
};

}  // namespace armature::wam
