// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/emulator/rotors.hpp"

#include <array>
#include <chrono>
#include <cmath>

namespace armature::wam {
namespace {

/// Of the motors with what turns on their shafts [kg m^2].
constexpr std::array<double, 7> kInertias{1.1631e-4, 1.1831e-4, 1.1831e-4, 1.0686e-4,
                                          1.685e-5,  1.745e-5,  1.42e-6};

}  // namespace

Rotors::Rotors(std::size_t count, base::Time begin, const Config& config)
    : config_(config), now_(begin) {
  for (std::size_t motor = 0; motor < count; ++motor) rotors_.push_back({kInertias[motor]});
}

void Rotors::advance_to(base::Time now) {
  const double dt = std::chrono::duration<double>(now - now_).count();
  now_ = now;
  for (Rotor& rotor : rotors_) {
    const double damping = config_.friction + (rotor.braked ? config_.braking : 0.0);
    if (damping == 0.0) {
      const double acceleration = rotor.torque / rotor.inertia;
      rotor.angle += (rotor.velocity + acceleration * dt / 2.0) * dt;
      rotor.velocity += acceleration * dt;
    } else {
      const double final_velocity = rotor.torque / damping;
      const double time_constant = rotor.inertia / damping;
      const double faded = -std::expm1(-dt / time_constant);
      const double excess = rotor.velocity - final_velocity;
      rotor.angle += final_velocity * dt + excess * time_constant * faded;
      rotor.velocity -= excess * faded;
    }
  }
}

void Rotors::drive(std::size_t motor, double torque) {
  rotors_[motor].torque = torque;
  rotors_[motor].braked = false;
}

void Rotors::brake(std::size_t motor) {
  rotors_[motor].torque = 0.0;
  rotors_[motor].braked = true;
}

void Rotors::set_state(std::size_t motor, double angle, double velocity) {
  rotors_[motor].angle = angle;
  rotors_[motor].velocity = velocity;
}

}  // namespace armature::wam
