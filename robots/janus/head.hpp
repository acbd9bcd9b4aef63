// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"
#include "armature/control/dc_motor.hpp"
#include "armature/sim/plant.hpp"
#include "robots/janus/aic/aic_wiring.hpp"

namespace armature::janus {

constexpr std::size_t kJoints = 2;
constexpr double kSupplyVoltage = 12.0;
constexpr double kCountsPerTurn = 2000.0;  ///< of the motor
constexpr double kIndexHalfWidth = 0.01;   ///< [rad] about 0
/// [N m] at joint 2: 0.25 N m at the motor's shaft, so more than the motor itself can do.
constexpr double kBrakeTorque = 25.0;
/// Of both joints; the friction is the URDF's.
constexpr control::DcMotor::Config kMotor{.resistance_ohm = 2.0,
                                          .torque_constant = 0.035,
                                          .gear_ratio = 100.0,
                                          .viscous_friction = 0.02,
                                          .coulomb_friction = 0.08,
                                          .coulomb_velocity = 0.0,
                                          .rotor_inertia = 1.2e-5};

/// The simulated head: links, motors, encoders, index switches, and the brake of joint 2. Joint 1
/// has none, so there the brake output of its card leads nowhere.
///
/// Time passes where it is asked for: each look at a joint brings the head to the time of the look.
class Head {
 public:
  struct Config {
    std::string urdf_file;  ///< robots/janus/janus.urdf
    base::Duration inner_step = std::chrono::microseconds(100);
    std::array<double, kJoints> initial_position{};  ///< [rad]
    base::Time begin{};                              ///< when it is there, at rest
  };

  static base::Result<std::unique_ptr<Head>> load(const Config& config);
  /// @param urdf  the text of the URDF, instead of the file
  static base::Result<std::unique_ptr<Head>> parse(const std::string& urdf, const Config& config);
  Head(const Head&) = delete;
  Head& operator=(const Head&) = delete;
  ~Head();

  /// Lets time pass until `now`; a time in the past changes nothing.
  /// @rt nonblocking, no allocation
  void advance_to(base::Time now);

  /// Where a joint is at `now` [rad], without an encoder's steps.
  /// @rt nonblocking, no allocation
  double position(std::size_t joint, base::Time now);
  /// [rad/s]
  /// @rt nonblocking, no allocation
  double velocity(std::size_t joint, base::Time now);

  /// What a card is wired to.
  AicWiring& wiring(std::size_t joint);
  /// kDiverged: the head stands still since then.
  sim::PlantStatus status() const { return plant_.status(); }

 private:
  class Wiring;

  Head(sim::Plant plant, const Config& config);
  base::Time reached() const { return begin_ + plant_.time(); }
  static base::Result<std::unique_ptr<Head>> assemble(base::Result<sim::Plant> plant,
                                                      const Config& config);

  const base::Time begin_;
  sim::Plant plant_;
  std::array<std::unique_ptr<Wiring>, kJoints> wirings_;
};

}  // namespace armature::janus
