// SPDX-License-Identifier: Apache-2.0
#include "benchmarks/control_cycle/comparison.hpp"

#include <cstdio>

#include "benchmarks/control_cycle/components.hpp"

namespace armature::benchmarks {

std::string difference_of(const exec::Application& application, const MonolithicController& loop,
                          int joints) {
  for (int i = 0; i < joints; ++i) {
    const std::string card = "Card" + std::to_string(i + 1);
    const SimulatedMotor& ours = static_cast<const Card*>(application.find(card))->motor();
    const SimulatedMotor& theirs = loop.motor(i);
    if (ours == theirs) continue;
    char text[160];
    std::snprintf(text, sizeof text, "the motor of %s has %.17g V, that of the loop %.17g V",
                  card.c_str(), ours.voltage(), theirs.voltage());
    return text;
  }
  return "";
}

}  // namespace armature::benchmarks
