// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "armature/library/base/changes.hpp"
#include "armature/library/base/controller.hpp"
#include "robots/wam/joint_controller.hpp"

namespace armature::wam {

/// The arm's own controller (paper 3, ControllerWAM): JointController, in the place of another
/// Controller; the hardware compensates gravity. Gains are one number for each joint, or one for
/// all; without any they are the vendor's for so many joints. A start neither kicks nor has a past.
/// @rt nonblocking, no allocation, O(joints)
class ControllerWam final : public library::Controller {
 public:
  using Controller::Controller;

 private:
  component::Outcome on_configure() override;
  component::Outcome on_start() override;
  void controller_now(const std::vector<double>& measured) override;
  component::Outcome set_up();
  base::Result<std::vector<JointGains>> gains() const;

  using Numbers = component::Property<std::vector<double>>;
  Numbers kp_{this, "Kp", {}, "of the vendor, if none", "Nm/rad"};
  Numbers ki_{this, "Ki", {}, "of the vendor, if none", "Nm/(rad s)"};
  Numbers kd_{this, "Kd", {}, "of the vendor, if none", "Nm s/rad"};
  Numbers max_torque_{this, "MaxTorque", {}, "of the vendor, if none", "Nm"};
  library::Changes changes_{joints_, period_, kp_, ki_, kd_, max_torque_};
  std::optional<JointController> law_;
  bool begun_ = false;  ///< since the start
  std::vector<double> torques_;
};

}  // namespace armature::wam
