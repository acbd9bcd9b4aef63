// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "robots/wam/emulator/motors.hpp"

namespace armature::wam {

/// Motors that move nothing but their own rotors: no gravity, no stops, no coupling. Exact at any
/// time, since a rotor with viscous friction has a closed solution.
class Rotors final : public Motors {
 public:
  struct Config {
    double friction = 0.0;  ///< [Nm s/rad] of each, >= 0
    double braking = 1e-3;  ///< [Nm s/rad] of a braked motor, besides that, >= 0
  };

  /// @param count  4 or 7; at rest at angle 0
  Rotors(std::size_t count, base::Time begin, const Config& config);

  std::size_t count() const override { return rotors_.size(); }
  void advance_to(base::Time now) override;
  double angle(std::size_t motor) const override { return rotors_[motor].angle; }
  void drive(std::size_t motor, double torque) override;
  void brake(std::size_t motor) override;

  /// Puts a motor somewhere: where a test begins.
  void set_state(std::size_t motor, double angle, double velocity);
  double velocity(std::size_t motor) const { return rotors_[motor].velocity; }
  double torque(std::size_t motor) const { return rotors_[motor].torque; }
  bool braked(std::size_t motor) const { return rotors_[motor].braked; }

 private:
  struct Rotor {
    double inertia;  // [kg m^2]
    double angle = 0.0;
    double velocity = 0.0;
    double torque = 0.0;
    bool braked = true;
  };

  const Config config_;
  base::Time now_;
  std::vector<Rotor> rotors_;
};

}  // namespace armature::wam
