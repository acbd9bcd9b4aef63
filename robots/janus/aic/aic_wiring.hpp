// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "armature/base/time.hpp"

namespace armature::janus {

/// What a card's connectors lead to: encoder, index switch, motor bridge and brake of one joint.
/// `now` is the time of the card and never goes back.
class AicWiring {
 public:
  AicWiring() = default;
  AicWiring(const AicWiring&) = delete;
  AicWiring& operator=(const AicWiring&) = delete;
  virtual ~AicWiring() = default;

  /// Counts of the encoder since the last call.
  virtual std::int64_t take_counts(base::Time now) = 0;
  virtual bool index_closed(base::Time now) = 0;
  /// [A] through the motor
  virtual double motor_current(base::Time now) = 0;

  /// @param share  of the supply, -1 to 1
  virtual void drive(double share, base::Time now) = 0;
  /// Opens the motor's winding.
  virtual void switch_off(base::Time now) = 0;
  virtual void apply_brake(base::Time now) = 0;
  virtual void release_brake(base::Time now) = 0;
};

}  // namespace armature::janus
