// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"

namespace armature::control {

/// How one joint gets from standing on its own to being held: first the effort that holds it, then
/// the brake opens (without a brake: the motor is switched on), then it is watched. It only says
/// what to do next.
///
/// With a brake the effort grows against it, as the joint's limiter lets it, until it has settled.
/// Without one nothing is driven until the command has settled; the motor begins with that. A drive
/// takes its time to do what it was told: the effort counts from when the motor is on, and the
/// joint is watched from when the brake is open. One thread uses it.
class ArmingSequence {
 public:
  /// Positions in the unit of the joint (rad or m); efforts in that of the actuator.
  struct Config {
    double max_motion = 0.0;         ///< of the joint, before and after it is let go; > 0
    double effort_tolerance = 0.0;   ///< an effort that stays within has settled; > 0
    base::Duration settling_time{};  ///< for which it has to stay within, five steps at least; > 0
    base::Duration patience{};       ///< until it has settled, and until it is driven once it was
                                     ///< let go, at the longest; > settling_time
    base::Duration watch_time{};     ///< after it was let go; > 0
  };

  /// What has to be done next, or why it has failed.
  enum class Next {
    kWait,
    kLetGo,         ///< now: the effort has settled
    kDone,          ///< it is held
    kMovedBefore,   ///< fail: it moved before it was let go
    kNeverSettled,  ///< fail
    kNotHeld,       ///< fail: it moved when it was let go
    kNotDriven,     ///< fail: its drive has not done what it was told
  };

  /// What one step needs to know of the joint.
  struct Measured {
    double position = 0.0;
    double effort = 0.0;    ///< that is sent; without a brake, that would be
    bool caught_up = true;  ///< the effort is what is commanded
    bool driven = true;     ///< motor and brake have done what they were told last
  };

  /// An error names every field that is wrong, and what it should be.
  static base::Result<ArmingSequence> make(const Config& config);

  /// @rt nonblocking, no allocation
  void begin(double position, base::Time now);

  /// Once a period from begin() until it is done or fails.
  /// @rt nonblocking, no allocation
  Next step(const Measured& measured, base::Time now);

  bool let_go() const { return state_.let_go; }
  /// The farthest from where it was, before it was let go or since.
  double moved() const { return state_.moved; }

 private:
  struct State {
    bool let_go = false;
    base::Time since{};    ///< it began, or was let go
    base::Time driven{};   ///< since it was let go
    base::Time settled{};  ///< from when on the effort has been within
    int steps = 0;         ///< since then
    double place = 0.0;
    double moved = 0.0;
    double effort = 0.0;
  };

  explicit ArmingSequence(const Config& config) : config_(config) {}

  Next wait_for_effort(const Measured& measured, base::Time now);

  Config config_;
  State state_;
};

}  // namespace armature::control
