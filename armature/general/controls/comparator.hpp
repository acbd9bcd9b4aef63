// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/general/controls/unit_property.hpp"

namespace armature::general {

/// Tells when a value rises above a threshold, and when it falls below it again. Within the dead
/// band around the threshold it stays with what it said last.
class Comparator final : public component::Component {
 public:
  using Component::Component;

 private:
  component::Outcome on_start() override {
    known_ = false;
    return component::accepted();
  }
  void compare(double value) {
    const double half = dead_band_ / 2.0;
    const bool above = above_ && known_ ? value >= threshold_ - half : value > threshold_ + half;
    const bool changed = known_ && above != above_;
    above_ = above;
    known_ = true;
    is_above_.write(above);
    if (!changed) return;
    if (above) rose_.raise(value);
    if (!above) fell_.raise(value);
  }

  UnitProperty unit_{this, "Unit", "of the value and of all properties"};
  component::Property<double> threshold_{this,
                                         "Threshold",
                                         0.0,
                                         "with which it is compared",
                                         "",
                                         component::unit_of(unit_),
                                         component::changeable_while_running};
  component::Property<double> dead_band_{this,
                                         "DeadBand",
                                         0.0,
                                         "around the threshold, half of it on each side",
                                         "",
                                         component::unit_of(unit_),
                                         component::range(0.0, 1e300),
                                         component::changeable_while_running};
  component::InputPort<double> in_{this,
                                   "In",
                                   "what is compared",
                                   "",
                                   component::on_data<&Comparator::compare>,
                                   component::unit_of(unit_)};
  component::OutputPort<bool> is_above_{this, "Above", "whether it is above the threshold"};
  component::Event<double> rose_{this, "Rose", "it is above the threshold now", {"value"}};
  component::Event<double> fell_{this, "Fell", "it is below the threshold now", {"value"}};
  bool above_ = false;
  bool known_ = false;
};

}  // namespace armature::general
