// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/base/result.hpp"

namespace armature::control {

/// Where a joint is, by a sensor that tells where its axis is, not only how far it turned: behind a
/// gear, from another zero, and beyond the turn after which the sensor begins again. One thread
/// uses it.
class AbsolutePosition {
 public:
  /// Positions of the joint in its unit (rad or m), those of the sensor in rad of its axis.
  struct Config {
    double ratio = 1.0;   ///< motion of the joint per motion of the sensor, not 0
    double offset = 0.0;  ///< where the joint is when the sensor says 0
    /// After which the sensor begins again; the first reading is taken between minus and plus half
    /// of it. 0: it counts turns.
    double range = 0.0;
    double max_velocity = 0.0;  ///< that the joint can have, > 0
  };

  /// What one reading says.
  struct Reading {
    double position = 0.0;
    double displacement = 0.0;  ///< since the reading before, 0 in the first one
    double possible = 0.0;      ///< as far as the joint can have moved meanwhile
    bool jumped = false;        ///< farther than that
  };

  /// An error names every field that is wrong, and what it should be.
  static base::Result<AbsolutePosition> make(const Config& config);

  /// The next reading is the first one.
  /// @rt nonblocking, no allocation
  void reset() { known_ = false; }
  bool known() const { return known_; }
  /// By the last reading, also by one that jumped.
  double position() const { return position_; }
  /// Where the joint is when the sensor says 0; within a range of it.
  double offset() const { return config_.offset; }

  /// The joint was found to be elsewhere than the sensor says, by so much. Its next first reading
  /// is of where it is then, however many ranges it has passed.
  /// @param by  finite
  /// @rt nonblocking, no allocation
  void shift(double by);

  /// @param of_sensor  finite
  /// @param elapsed_s  since the reading before, >= 0; of no account in the first one
  /// @rt nonblocking, no allocation
  Reading step(double of_sensor, double elapsed_s);

  /// What the sensor would say of a position, counted on from its last reading: for a drive that is
  /// told where to go by what it says itself.
  /// @rt nonblocking, no allocation
  double at(double position) const { return last_ + (position - position_) / config_.ratio; }

 private:
  explicit AbsolutePosition(const Config& config) : config_(config) {}

  double within_range(double of_sensor) const;

  Config config_;
  bool known_ = false;
  double last_ = 0.0;  ///< of the sensor
  double position_ = 0.0;
};

}  // namespace armature::control
