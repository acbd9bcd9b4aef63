// SPDX-License-Identifier: Apache-2.0
#include "benchmarks/control_cycle/comparison.hpp"

#include <cstdio>

#include "benchmarks/control_cycle/stand_ins.hpp"

namespace armature::benchmarks {

std::string difference_of(const exec::Application& application, MonolithicController& loop,
                          int joints) {
  const auto card_of = [&](int joint) {
    return static_cast<const Card*>(application.find("Card" + std::to_string(joint + 1)));
  };
  if (loop.cycles() > card_of(0)->driven()) return "the loop has done more cycles";
  while (loop.cycles() < card_of(0)->driven()) loop.cycle();
  for (int i = 0; i < joints; ++i) {
    const SimulatedMotor& ours = card_of(i)->motor();
    const SimulatedMotor& theirs = loop.motor(i);
    if (ours == theirs) continue;
    char text[160];
    std::snprintf(text, sizeof text, "the motor of %s has %.17g V, that of the loop %.17g V",
                  card_of(i)->name().c_str(), ours.voltage(), theirs.voltage());
    return text;
  }
  return "";
}

}  // namespace armature::benchmarks
