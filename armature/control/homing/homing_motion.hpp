// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "armature/base/result.hpp"
#include "armature/control/still_watch.hpp"

namespace armature::control {

/// What a joint finds its position by.
enum class HomeSign : std::uint8_t {
  kIndex,            ///< a mark of its encoder
  kSwitch,           ///< where a switch opens that the joint comes away from
  kSwitchThenIndex,  ///< the first mark after that
  kHardStop,         ///< where it ends
};

/// The motion by which a joint looks for home, seen from where it began: what velocity it is to
/// have next, and whether it obeys. It moves nothing itself, and knows no positions. One thread
/// uses it.
///
/// A switch is approached with `velocity`, and left with a fifth of it: home is where it opens, and
/// stays open. A joint that begins at its switch leaves it at once. An index mark is looked for
/// with `velocity`, or from the switch on with a fifth of it. A hard stop is where a joint that is
/// told to move does not. It is believed only if the joint comes away from it, by `back_off`, and
/// finds it again with a fifth of the velocity at the same place: a sensor that is dead, a brake
/// that did not open and a load that gives way do not pass for one.
///
/// Whenever it begins to move or turns round, what drives it has to overcome its friction first,
/// and what has pushed it the other way: until it must have (`lead`, `patience_s`) the joint may be
/// anywhere on the way that it was told to go. It is no stop that it does not move then.
///
/// The motion ends at rest. Where it would leave `travel` it comes to rest before, and has failed.
/// What the joint does is compared with what it was told, in windows of 50 ms or more.
class HomingMotion {
 public:
  /// Positions in the unit of the joint (rad or m), and seconds.
  struct Config {
    HomeSign sign = HomeSign::kIndex;
    double velocity = 0.0;      ///< towards the sign; not 0, negative: backwards
    double acceleration = 0.0;  ///< > 0
    double travel = 0.0;        ///< that it may be away from where it began; > 4 tolerance
    double back_off = 0.0;      ///< > 2 tolerance, < travel; of a hard stop
    double tolerance = 0.0;     ///< more than a few counts of the sensor; > 0
    /// As far as what it is told may be ahead of it: with more it would push harder; > 0.
    double lead = 0.0;
    /// In which it need not come back yet when it turns round, since its drive, which has pushed,
    /// takes that back by itself; >= 0.
    double patience_s = 0.0;
    double period_s = 0.0;  ///< > 0
  };

  /// What was measured in this period.
  struct Measured {
    double way = 0.0;  ///< from where it began
    bool switch_closed = false;
    bool index_passed = false;  ///< since the period before
    double since_index = 0.0;   ///< way since then
  };

  /// What the motion has come to.
  enum class Status : std::uint8_t {
    kGoesOn,
    kHome,          ///< it rests; home is at found_at()
    kNothingFound,  ///< it rests at the end of its travel
    kBeyond,        ///< it is outside its travel
    kBlocked,       ///< it was told to move, and did not
    kAstray,        ///< it moved otherwise than it was told
    kStopGaveWay,   ///< it was stopped elsewhere the second time: by no hard stop
  };

  /// What is looked for at the moment, for who has to say what was missing.
  enum class Stage : std::uint8_t {
    kSearching,     ///< for the sign
    kToEdge,        ///< for the switch to open
    kToIndex,       ///< for the mark behind it
    kBackingOff,    ///< away from the stop
    kFindingAgain,  ///< the stop
    kEnding,        ///< for rest
  };

  HomingMotion() = default;
  /// An error names every field that is wrong, and what it should be.
  static base::Result<HomingMotion> make(const Config& config);

  /// It rests where it is.
  /// @param switch_closed  now
  /// @rt nonblocking, no allocation
  void begin(bool switch_closed);

  /// Once a period.
  /// @rt nonblocking, no allocation
  Status step(const Measured& measured);

  /// That it is to have now, and the way from where it began where it is to be.
  double velocity() const { return velocity_; }
  double desired_way() const { return desired_; }

  Stage stage() const { return stage_; }
  /// Where home is, from where it began; once the sign was found.
  double found_at() const { return found_at_; }
  /// Of the last window: what it was told to move, and has moved.
  double told() const { return told_; }
  double moved() const { return moved_; }
  const Config& config() const { return config_; }

 private:
  explicit HomingMotion(const Config& config) : config_(config) {}

  Status judge(const Measured& measured);
  bool is_astray() const;
  Status end_window(double way);
  void begin_window(double way);
  Status touch(double way);
  void look(const Measured& measured);
  void look_for_sign(const Measured& measured);
  void look_for_edge(const Measured& measured);
  void enter(Stage stage, double target);
  void go_on(double way);
  void note_direction(double way);
  bool has_taken_up(double way) const;
  bool would_leave(double way) const;
  bool looks_for_stop() const;
  double slowly_back() const { return -0.2 * config_.velocity; }
  double outwards(double length) const { return config_.velocity > 0.0 ? length : -length; }

  Config config_;
  StillWatch still_;
  Stage stage_ = Stage::kSearching;
  bool gives_up_ = false;            ///< comes to rest at the end of its travel
  bool was_closed_ = false;          ///< the switch, since it turned round
  std::optional<double> opened_at_;  ///< the switch, if it is open since
  std::optional<double> mark_;       ///< the first one since then
  bool found_again_ = false;         ///< the stop
  double target_ = 0.0;              ///< velocity
  double velocity_ = 0.0;
  double desired_ = 0.0;
  double touched_ = 0.0;  ///< the stop, there
  double found_at_ = 0.0;
  double window_begin_ = 0.0;
  double told_ = 0.0;
  double moved_ = 0.0;
  int steps_ = 0;            ///< of the window
  double side_ = 0.0;        ///< of the velocity: 1, -1, or 0 at rest
  double last_side_ = 0.0;   ///< the same, before it rested
  bool takes_up_ = false;    ///< it has begun to move, or turned round, and may not follow yet
  int to_wait_ = 0;          ///< steps of that at least
  bool full_speed_ = false;  ///< during all of it
};

}  // namespace armature::control
