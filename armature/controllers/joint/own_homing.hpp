// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "armature/component/author.hpp"
#include "armature/control/homing/homing_motion.hpp"
#include "armature/control/joint_limiter.hpp"
#include "armature/controllers/joint/homing_settings.hpp"

namespace armature::controllers {

/// How a joint homes that does so by itself: the motion, what drives the joint along it, and a
/// limiter of its own, which lets nothing out of its travel, above twice its velocity, or above
/// HomingEffort. All ways are counted from where the joint began. The joint writes the commands.
/// @rt nonblocking, no allocation, but for set_up
/// @thread the component's own
class OwnHoming {
 public:
  using Measured = control::JointLimiter::Measured;
  using Status = control::HomingMotion::Status;

  OwnHoming(JointCommand way, const HomingProperties& settings, const JointProperties& joint)
      : way_(way), settings_(settings), joint_(joint) {}

  component::Outcome set_up(base::Duration period);

  /// What a drive that follows by itself is bound to, at the joint; infinite: it is not. Of a joint
  /// that is given efforts its limiter sees to that.
  double most_effort() const;

  /// The joint rests; from now on there is a permit, and commands that hold it there.
  bool hold();
  /// It is let go, and looks for home from now on.
  void search(bool switch_closed);
  Status step(const control::HomingMotion::Measured& measured);
  void disarm();
  control::DrivePermit permit() const { return limiter_->permit(); }
  bool armed() const { return limiter_ && limiter_->armed(); }

  // What the joint's hardware is to be told, in its units.
  control::LimitedEffort effort(const Measured& measured);
  control::LimitedVelocity velocity(const Measured& measured);
  control::LimitedPosition position(const Measured& measured);

  const control::HomingMotion& motion() const { return motion_; }
  /// What is wrong, with what was measured.
  /// @param status  that the motion has come to, not kGoesOn or kHome
  component::Reason why(Status status, double way) const;

 private:
  control::HomingMotion::Config motion_config() const;
  control::JointLimiter::Config limits(base::Duration period) const;
  double lead() const;
  component::Reason& append_missing(component::Reason& why) const;
  component::Reason& append_length(component::Reason& why, double length) const;

  const JointCommand way_;
  const HomingProperties& settings_;
  const JointProperties& joint_;
  double period_s_ = 0.0;
  std::optional<control::JointLimiter> limiter_;  ///< none: it does not home by itself
  control::HomingMotion motion_;
  bool searches_ = false;
};

}  // namespace armature::controllers
