// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"
#include "armature/control/motion_limit.hpp"
#include "armature/control/online/online_trajectory.hpp"
#include "armature/control/taught/timed_path.hpp"

namespace armature::control {

/// Why a `TaughtPlayer` does not play a path.
enum class PlayRefusal {
  kNone,
  kWrongNumber,    ///< not whole rows of one number for each axis, at least 4
  kTooLong,        ///< more rows than there is memory for
  kNotFinite,      ///< a number of the path is not
  kOutsideLimits,  ///< the path leaves the position limits of an axis
  kSpeed,          ///< the speed is not from 0.01 to 10
  kNoPosition,     ///< where the axes are is no admissible place to begin
  kElsewhere,      ///< the axes are not at rest at the begin of the path
};

/// A few words for a message, such as "the motion leaves the limits of an axis".
/// @rt nonblocking, no allocation
std::string_view to_text(PlayRefusal refusal);

/// Plays a taught path (see TaughtMotion) at any speed: first all axes move to its begin with
/// limited jerk (`OnlineTrajectory`), meanwhile the path is timed (`TimedPath`), then they follow
/// it. What is refused changes nothing. One thread uses it.
class TaughtPlayer {
 public:
  static constexpr std::size_t kNoAxis = static_cast<std::size_t>(-1);
  static constexpr double kSlowest = 0.01;
  static constexpr double kFastest = 10.0;
  /// At the begin of the path, so that the robot is there, too.
  static constexpr double kSettling_s = 0.5;
  /// Of an axis at rest to the begin of a path that begins there [rad, m].
  static constexpr double kHere = 2e-3;

  /// The axes, and how long a path may be.
  struct Config {
    std::vector<OnlineTrajectory::Axis> axes;  ///< at least one
    double longest_s = 60.0;                   ///< of a teaching, > 0
  };
  /// Whether a path is played, and if not, why.
  struct [[nodiscard]] Answer {
    PlayRefusal refusal = PlayRefusal::kNone;
    std::size_t axis = kNoAxis;  ///< the first one it is about, if it is about one
    double found = 0.0;          ///< of kOutsideLimits and kElsewhere: the position

    bool accepted() const { return refusal == PlayRefusal::kNone; }
  };

  /// An error names every field that is wrong, and what it should be.
  static base::Result<TaughtPlayer> make(const Config& config);

  /// What is wrong with a path wherever the axes are.
  /// @param points  control points x axes [rad]
  /// @rt nonblocking, no allocation, O(points)
  Answer check(std::span<const double> points, double speed) const;

  /// Moves from `state`, in any motion, to the begin of the path, and plays it.
  /// @param whole  limit of the whole robot, asked until the path begins; nullptr if there is none
  /// @rt nonblocking, no allocation, O(points)
  Answer play(const OnlineTrajectory::State& state, std::span<const double> points, double speed,
              MotionLimit* whole);

  /// The same from where the axes rest: refuses what begins elsewhere, and waits for nothing.
  /// @rt nonblocking, no allocation, O(points)
  Answer play_from_here(const OnlineTrajectory::State& state, std::span<const double> points,
                        double speed, MotionLimit* whole);

  /// Goes on by `period`, >= 0.
  /// @rt nonblocking, no allocation, O(axes)
  void step(base::Duration period);
  /// Brakes to rest, on the path if it plays already.
  /// @rt nonblocking, no allocation, O(axes)
  void stop();
  /// Ends at once: the axes are somebody else's.
  void let_go() { stage_ = Stage::kIdle; }

  std::size_t capacity() const { return path_.capacity(); }  ///< control points of a path
  bool under_way() const { return stage_ != Stage::kIdle; }
  /// On the path, no more on the way to its begin.
  bool on_path() const { return stage_ == Stage::kPath; }
  bool slowed() const { return path_.slowed(); }
  /// False if it ended since the limit of the whole robot forbids the path.
  bool possible() const { return path_.possible(); }
  /// Until it ends; before the path is planned, as the wanted speed would have it.
  double remaining_s() const;
  /// What has passed of the whole, 0..1; never falls.
  double progress() const { return progress_; }

  /// One number per axis.
  std::span<const double> positions() const;
  std::span<const double> velocities() const;
  std::span<const double> accelerations() const;

 private:
  enum class Stage { kIdle, kApproach, kPath };
  TaughtPlayer(OnlineTrajectory approach, const Config& config);

  void find_start(std::span<const double> points);
  double passed_share() const;
  void begin_path();

  std::vector<OnlineTrajectory::Axis> axes_;
  OnlineTrajectory approach_;
  TimedPath path_;
  MotionLimit* whole_ = nullptr;  ///< of the whole robot
  Stage stage_ = Stage::kIdle;
  bool stopping_ = false;
  bool on_path_last_ = false;  ///< where the positions are from
  double passed_s_ = 0.0;
  double rested_s_ = 0.0;  ///< at the begin of the path
  double progress_ = 0.0;
  std::vector<double> start_;
};

}  // namespace armature::control
