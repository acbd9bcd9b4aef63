// SPDX-License-Identifier: Apache-2.0
#pragma once

// What shows a value to whoever looks: on a page, in the task browser, in a recording. They do
// nothing else.

#include "armature/general/controls/unit_property.hpp"

namespace armature::general {

/// Shows whether something holds.
class Light final : public component::Component {
 public:
  using Component::Component;

 private:
  component::InputPort<bool> on_{this, "On", "whether it shines"};
};

/// Shows a number.
class Number final : public component::Component {
 public:
  using Component::Component;

 private:
  UnitProperty unit_{this, "Unit", "of the number"};
  component::InputPort<double> value_{this, "Value", "what is shown", "",
                                      component::unit_of(unit_)};
};

/// Shows how numbers went in the last minute.
class Plot final : public component::Component {
 public:
  using Component::Component;

 private:
  UnitProperty unit_{this, "Unit", "of all curves"};
  component::Property<int> inputs_{
      this, "Inputs", 1, "how many curves", "", component::range(1, 100)};
  component::InputPorts<double> in_{this, "In", inputs_, "a curve", "", component::unit_of(unit_)};
};

}  // namespace armature::general
