// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"

namespace armature::control {

/// Watches one joint that is to stand: how far and how fast it moves, and whether the effort that
/// holds it shakes. It only judges; whoever asks brakes.
///
/// The joint's place is where it comes to rest after stand(). A joint that nothing drives may sink
/// by its weight: as long as it is no faster than `sinking_velocity` its place follows it. One
/// thread uses it.
class HoldingWatch {
 public:
  /// Positions in the unit of the joint (rad or m) and seconds; efforts in that of the actuator.
  struct Config {
    base::Duration period{};        ///< between two steps; > 0
    double max_motion = 0.0;        ///< away from its place; > 0
    double max_velocity = 0.0;      ///< in kFastSteps steps in a row; > 0
    double sinking_velocity = 0.0;  ///< of a joint that is not driven; >= 0, <= max_velocity
    double least_effort = 0.0;      ///< smaller ones count as none; >= 0
    /// Share of steps in which the effort has another sign than in the step before, as a mean over
    /// about `alternation_time`; > 0, above 1: it is not looked at.
    double max_alternation = 2.0;
    base::Duration alternation_time{};  ///< > 0 where alternation is looked at
    double rest_velocity = 0.0;         ///< slower is at rest; > 0
    base::Duration settling_time{};     ///< to come to rest after stand(), at the longest; >= 0
  };

  /// What a step found; from kMoved on it is an alarm.
  enum class Verdict {
    kMay,         ///< move: it is not to stand
    kSettles,     ///< it comes to rest
    kStands,      ///< at its place
    kSinks,       ///< not driven, as slowly as its weight may
    kMoved,       ///< farther than max_motion
    kFast,        ///< faster than max_velocity, or than it may sink
    kAlternates,  ///< the effort shakes
  };

  /// A verdict with its figures.
  struct Finding {
    Verdict verdict = Verdict::kMay;
    double measured = 0.0;  ///< motion, velocity, or share
    double bound = 0.0;     ///< what it should have stayed below

    /// It has to be braked.
    bool is_alarm() const { return verdict >= Verdict::kMoved; }
  };

  /// What one step needs to know of the joint.
  struct Measured {
    double position = 0.0;
    double velocity = 0.0;
    double effort = 0.0;  ///< as it was sent
    bool driven = false;  ///< the motor is on, and no brake closed
  };

  static constexpr int kFastSteps = 3;

  /// An error names every field that is wrong, and what it should be.
  static base::Result<HoldingWatch> make(const Config& config);

  /// From now on it is to stand; nothing happens if it already is.
  /// @rt nonblocking, no allocation
  void stand();
  /// From now on it may move.
  /// @rt nonblocking, no allocation
  void move();
  bool is_to_stand() const { return state_.phase != Phase::kMayMove; }

  /// Once a period.
  /// @rt nonblocking, no allocation
  Finding step(const Measured& measured) {
    if (!is_to_stand()) return {};
    if (stands(measured)) [[likely]]
      return {.verdict = Verdict::kStands};
    return judge(measured);
  }
  /// In place of `step` where only the effort is to be judged, since the joint may move.
  /// @rt nonblocking, no allocation
  Finding judge_effort(double effort);

 private:
  enum class Phase { kMayMove, kSettling, kStanding };
  struct State {
    Phase phase = Phase::kMayMove;
    base::Duration settling_for{};
    double place = 0.0;
    double last_sign = 0.0;  ///< of the last effort that counts
    double alternation = 0.0;
    int fast_steps = 0;
  };

  explicit HoldingWatch(const Config& config);

  /// Driven, slow and at its place, as nearly always: to see that costs a few comparisons.
  bool stands(const Measured& measured) const {
    return state_.phase == Phase::kStanding && config_.max_alternation > 1.0 && measured.driven &&
           state_.fast_steps == 0 && std::abs(measured.velocity) <= config_.max_velocity &&
           std::abs(measured.position - state_.place) <= config_.max_motion;
  }
  Finding judge(const Measured& measured);
  bool settles(const Measured& measured);
  Finding judge_motion(const Measured& measured);
  void count_alternation(double effort);

  Config config_;
  double alternation_weight_;  ///< of one step
  State state_;
};

}  // namespace armature::control
