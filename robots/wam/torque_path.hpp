// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"
#include "armature/control/arming/hand_over.hpp"
#include "armature/control/arming/reference_brake.hpp"
#include "armature/control/dynamics/inverse_dynamics.hpp"
#include "armature/control/joint_limiter.hpp"
#include "armature/control/transmission.hpp"
#include "armature/types/enum.hpp"
#include "robots/wam/joint_controller.hpp"

namespace armature::wam {

/// What becomes of torques of which one is above its limit.
enum class OverLimit : std::uint8_t {
  kClip,       ///< that one is cut to its limit
  kRefuseAll,  ///< none of them is sent (paper 3, section 6.1)
};
ARMATURE_ENUM(OverLimit, kClip, kRefuseAll);

/// The one way of torques to the motors, and what holds the arm where nobody commands it:
///
///     command - weight -> limiter of each joint -> + weight -> largest torque -> largest growth
///                                                                             -> motors
///
/// Off, all torques are 0. Holding, the vendor's joint controller brakes the arm to rest and keeps
/// it there, besides its weight. Weightless, its weight is all that is driven: a hand may lead it.
/// Driven, commands are passed; a JointLimiter judges what of them
/// moves the arm, and lets it grow slowly after the first. The weight is always this class's own,
/// so that an arm whose command is cut falls nowhere. Going over from one to the other makes no
/// step: what the one drove with dies away while the other takes over.
///
/// Every function but `make` is nonblocking and allocates nothing. One thread uses it.
class TorquePath {
 public:
  struct Config {
    std::vector<JointGains> hold;  ///< one for each joint, as are all
    std::vector<control::JointLimiter::Config> limits;
    std::vector<double> max_torque;        ///< [N m] with the weight, > 0
    std::vector<double> max_growth;        ///< [N m] in one cycle, > 0; towards 0 there is no limit
    std::vector<double> max_acceleration;  ///< [rad/s^2] that holding brakes with, > 0
    bool command_has_weight = false;       ///< commands hold the arm's weight already
    OverLimit over_limit = OverLimit::kClip;
    base::Duration hand_over{};  ///< in which the difference dies away
    double period_s = kPeriod;
  };
  enum class Mode { kOff, kHolding, kWeightless, kDriven };
  enum class Result {
    kPassed,
    kClipped,    ///< by a limit of a joint; see `clipped`
    kRefused,    ///< one is above its limit, and OverLimit::kRefuseAll: nothing has changed
    kNotFinite,  ///< of the command or what was measured: nothing but the weight is driven
  };

  /// An error names what is wrong.
  static base::Result<TorquePath> make(const Config& config, control::Transmission transmission,
                                       control::InverseDynamics links);

  /// Where the joints are, for what follows.
  /// @param positions   [rad]
  /// @param velocities  [rad/s]
  void measure(std::span<const double> positions, std::span<const double> velocities);

  void go_off();
  enum class Last { kDiesAway, kEndsAtOnce };
  /// From where the joints are, as fast as they are.
  /// @param driven  what drove them last: it ends at once if it was what is not to go on
  void begin_to_hold(Last driven = Last::kDiesAway);
  /// @return false, and it goes on as it was, unless it holds and the joints are known
  bool begin_to_drive();
  /// From now on nothing but the weight is driven; what held the arm dies away.
  /// @return false, and it goes on as it was, unless it holds and the joints are known
  bool begin_to_float();
  Mode mode() const { return mode_; }

  /// The torques of a cycle, once in each.
  void step_hold(base::Time now);
  void step_float(base::Time now);
  /// @param command  [N m] of the joints
  Result step_drive(std::span<const double> command, base::Time now);

  /// [N m], of the last step
  std::span<const double> motor_torques() const { return motors_; }
  std::span<const double> joint_torques() const { return torques_; }
  std::span<const double> weight() const { return weight_; }
  /// [N m] What drives or holds the joints, without the weight.
  std::span<const double> moving_torques() const { return driving_; }
  std::size_t joints() const { return positions_.size(); }
  /// The first joint, from 0, for which a command is above a limit of its torque; joints() if none.
  std::size_t first_over_limit(std::span<const double> command) const;
  /// Commands that a limit of a joint changed.
  int clipped() const { return clipped_; }

 private:
  TorquePath(const Config& config, control::Transmission transmission,
             control::InverseDynamics links, JointController holder, control::ReferenceBrake brake);

  void send(base::Time now);

  Config config_;
  control::Transmission transmission_;
  control::InverseDynamics links_;
  JointController holder_;
  control::ReferenceBrake brake_;
  std::vector<control::JointLimiter> limiters_;
  control::HandOver hand_over_;
  Mode mode_ = Mode::kOff;
  bool finite_ = false;         ///< what was measured
  bool measured_anew_ = false;  ///< since it began to hold: the reference has moved on, too
  int clipped_ = 0;
  std::vector<double> positions_;
  std::vector<double> velocities_;
  std::vector<double> motion_;  ///< [q, qd, 0]
  std::vector<double> weight_;
  std::vector<double> driving_;  ///< without the weight
  std::vector<double> settled_;  ///< what has held it lately, without the noise of single cycles
  std::vector<double> torques_;
  std::vector<double> motors_;
};

}  // namespace armature::wam
