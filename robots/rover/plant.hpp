// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"
#include "armature/sim/encoder.hpp"
#include "armature/sim/motor.hpp"
#include "armature/sim/world.hpp"

namespace armature::rover {

/// Where the rover is on its floor.
struct Place {
  double x = 0.0;        ///< [m]
  double y = 0.0;        ///< [m]
  double heading = 0.0;  ///< [rad] from x to y, -pi to pi
};

/// The simulated rover in its arena, with the drive of each wheel: motor, encoder, and a bridge
/// that drives with the voltage that it was told last, for 100 ms. Without a new one it shorts the
/// winding, and so it does while it is off: the motor brakes itself.
///
/// Time passes where it is asked for: each function with a time brings the rover there first.
class Plant {
 public:
  struct Config {
    int wheels = 2;  ///< 2 or 4
    base::Duration inner_step = std::chrono::milliseconds(1);
    base::Time begin{};  ///< when it is at its place, at rest
  };
  /// For which a voltage holds.
  static constexpr base::Duration kWatchdog = std::chrono::milliseconds(100);

  static base::Result<std::unique_ptr<Plant>> make(const Config& config);
  Plant(const Plant&) = delete;
  Plant& operator=(const Plant&) = delete;

  /// @rt nonblocking, no allocation
  void advance_to(base::Time now);
  std::size_t wheels() const { return drives_.size(); }

  // The drive of a wheel, from 0. Nonblocking, no allocation.
  void switch_on(std::size_t wheel, base::Time now);
  void switch_off(std::size_t wheel, base::Time now);
  /// @param voltage  [V], from now on
  void drive(std::size_t wheel, double voltage, base::Time now);
  /// Counts of the motor since the last call.
  std::int64_t take_counts(std::size_t wheel, base::Time now);
  /// False: it was switched off, or by its watchdog.
  bool is_on(std::size_t wheel) const { return drives_[wheel].on; }
  /// Opens the winding, whatever it is told: a motor that fails.
  void break_motor(std::size_t wheel, bool broken) { drives_[wheel].broken = broken; }

  /// As the last inner step left it.
  Place place() const;
  /// [rad/s] of the wheel
  double wheel_velocity(std::size_t wheel) const { return world_.velocity(drives_[wheel].axle); }
  /// [rad] of the wheel
  double wheel_angle(std::size_t wheel) const { return world_.position(drives_[wheel].axle); }
  /// A hand puts it there, at rest.
  void put(const Place& place);
  /// kDiverged: it stands still since then.
  sim::PlantStatus status() const { return world_.status(); }

 private:
  struct Drive {
    std::size_t axle;
    sim::Motor motor;
    sim::Encoder encoder;
    base::Time told_at{};
    bool on = false;
    bool broken = false;
  };

  Plant(sim::World world, std::size_t body, std::vector<Drive> drives, base::Time begin);
  base::Time reached() const { return begin_ + world_.time(); }
  double torque(Drive& drive) const;

  sim::World world_;
  const std::size_t body_;
  std::vector<Drive> drives_;
  const base::Time begin_;
};

}  // namespace armature::rover
