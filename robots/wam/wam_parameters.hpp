// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/component/author.hpp"
#include "robots/wam/arm_numbers.hpp"
#include "robots/wam/torque_path.hpp"

namespace armature::wam {

/// The properties of the hardware that say what torques may do. Vectors have one number for each
/// joint, or one for all.
class WamParameters {
 public:
  explicit WamParameters(component::Component* owner);

  /// An error names the property, what was expected and what was found.
  /// @thread configuration only
  base::Result<TorquePath::Config> torque_path(const ArmNumbers& numbers) const;
  double period() const { return period_; }

 private:
  using Numbers = component::Property<std::vector<double>>;

  base::Result<std::vector<JointGains>> gains(const ArmNumbers& numbers) const;

  component::Property<double> period_;
  component::Property<bool> controller_has_gravity_;
  component::Property<double> arming_time_;
  component::Property<double> hand_over_;
  Numbers lower_;
  Numbers upper_;
  Numbers max_velocity_;
  Numbers max_acceleration_;
  Numbers max_control_torque_;
  Numbers max_torque_;
  Numbers max_growth_;
  Numbers kp_;
  Numbers ki_;
  Numbers kd_;
  Numbers max_own_torque_;
};

}  // namespace armature::wam
