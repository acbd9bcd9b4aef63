// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "armature/component/author.hpp"
#include "armature/controllers/base/driven_joint.hpp"
#include "armature/controllers/base/joint_hardware.hpp"
#include "armature/controllers/joint/joint_settings.hpp"

namespace armature::controllers {

/// How a joint finds its position at the operator's command `home`.
enum class HomingMethod : std::uint8_t {
  kDrive,  ///< its hardware does, if it can
  kIndex,
  kSwitch,
  kSwitchThenIndex,
  kHardStop,
  kHere,  ///< it is where the operator says
};

/// None of that name: nothing.
std::optional<HomingMethod> homing_method(std::string_view name);

/// What a Joint is told of homing. Positions in its unit (rad or m).
struct HomingSettings {
  std::string method = "drive";
  double position = 0.0;   ///< at home
  double velocity = 0.0;   ///< towards the sign
  double travel = 0.0;     ///< that it may be away from where it began
  double effort = 0.0;     ///< at most; of a drive that follows [Nm or N], 0: what that can
  double stiffness = 0.0;  ///< of a joint that is commanded by an effort
  double damping = 0.0;
  double back_off = 0.05;  ///< of a hard stop
};

/// They are properties of a Joint.
class HomingProperties final : public component::Properties<HomingSettings>,
                               public component::Checked {
 public:
  /// @param units, joint  of it; outlive this
  HomingProperties(component::Component* owner, JointCommand command, const JointUnits& units,
                   const JointProperties& joint);

  HomingMethod method() const { return homing_method(get().method).value_or(HomingMethod::kDrive); }
  /// The joint moves by itself.
  bool moves() const { return method() != HomingMethod::kDrive && method() != HomingMethod::kHere; }

  /// The check has found that its sensor knows where it is, also after a restart.
  bool is_of_absolute_sensor() const { return is_of_absolute_sensor_; }

  /// What is wrong with them, whatever the hardware is; empty if nothing is.
  std::string objection() const;
  void check(component::Check& check) const override;

 private:
  std::string objection_to_motion() const;
  std::string objection_to_effort() const;
  std::string objection_to_unused() const;
  std::string objection_to_no_sampler() const;
  std::string objection_to(const JointHardware& hardware) const;
  std::string objection_to(const DrivenJoint& joint) const;

  component::Component& owner_;
  JointCommand command_;
  const JointProperties& joint_;
  mutable bool is_of_absolute_sensor_ = false;
};

}  // namespace armature::controllers
