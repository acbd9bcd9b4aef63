// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/general/controls/unit_property.hpp"

namespace armature::general {

/// Writes the number that the deployment or an operator gives it, in each of its cycles.
class Constant final : public component::Component {
 public:
  using Component::Component;

 private:
  void on_update() override { out_.write(value_); }

  UnitProperty unit_{this, "Unit", "of the number"};
  component::Property<double> value_{this,
                                     "Value",
                                     0.0,
                                     "what is written",
                                     "",
                                     component::unit_of(unit_),
                                     component::changeable_while_running};
  component::OutputPort<double> out_{this, "Out", "the number", "", component::unit_of(unit_)};
};

}  // namespace armature::general
