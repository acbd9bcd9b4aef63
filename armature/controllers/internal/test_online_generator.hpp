// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <memory>

#include <gtest/gtest.h>

#include "armature/controllers/axes_generator/axes_generator_online.hpp"
#include "armature/controllers/internal/test_generator.hpp"

namespace armature::controllers {

/// The online generator of two axes with 1 rad/s, 2 rad/s^2, 20 rad/s^3, -0.5 to 4.5 rad.
class OnlineGenerator : public AxesGenerator {
 protected:
  OnlineGenerator() : AxesGenerator(std::make_unique<AxesGeneratorOnline>("Generator")) {}
  /// At each of which the limits are looked at.
  void cycle(int count = 1) override {
    for (int i = 0; i < count; ++i) {
      const Vector before = desired_of("nAxesDesiredAcceleration");
      generator.write("nAxesSensorPosition", measured);
      generator.run_cycles();
      if (generator.writes("nAxesDesiredPosition") == 0u) return;
      for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_LE(std::abs(velocity()[k]), 1.0 + 1e-9);
        EXPECT_LE(std::abs(acceleration()[k]), 2.0 + 1e-9);
        EXPECT_GE(desired()[k], -0.5 - 1e-9);
        EXPECT_LE(desired()[k], 4.5 + 1e-9);
        if (before.size() == 2) {
          EXPECT_LE(std::abs(acceleration()[k] - before[k]), 20.0 * 0.01 + 1e-9);
        }
      }
    }
  }
  Vector desired_of(const char* port) {
    return generator.writes(port) == 0u ? Vector{} : generator.output<Vector>(port);
  }
};

}  // namespace armature::controllers
