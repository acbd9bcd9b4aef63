// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/general/controls/unit_property.hpp"

namespace armature::general {

/// Keeps the last number that it was told, and passes it on at once: a member of an event becomes a
/// value that other controls compute with. It has no cycles, so that readers see how old the number
/// is.
class Latch final : public component::Component {
 public:
  using Component::Component;

 private:
  component::Outcome set(double value) {
    if (value != value) return component::refused("it is set to a number, not to NaN");
    out_.write(value);
    set_.complete();
    return component::accepted();
  }

  UnitProperty unit_{this, "Unit", "of the number"};
  component::OutputPort<double> out_{this, "Out", "the number", "", component::unit_of(unit_)};
  component::Command<double> set_{this, "set", component::serve<&Latch::set>,
                                  "tells it another number", component::args("value [Unit]")};
};

}  // namespace armature::general
