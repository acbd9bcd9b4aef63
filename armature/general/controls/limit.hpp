// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "armature/general/controls/unit_property.hpp"

namespace armature::general {

/// Keeps a value between two bounds; with `Most` connected also between -Most and Most. What is no
/// number is not passed on.
class Limit final : public component::Component {
 public:
  using Component::Component;

 private:
  void on_check(component::Check& check) const override {
    if (low_ > high_) check.error("Low is above High", "exchange them");
  }
  void limit(double value) {
    if (value != value) return;
    const double within = symmetric(std::max(low_.get(), std::min(high_.get(), value)));
    clipped_.write(within != value);
    out_.write(within);
  }

  double symmetric(double value) {
    const auto most = most_.read();
    return most && most.value >= 0.0 ? std::clamp(value, -most.value, most.value) : value;
  }

  UnitProperty unit_{this, "Unit", "of all ports and bounds"};
  component::Property<double> low_{
      this, "Low", -1.0, "the least value", "", component::unit_of(unit_)};
  component::Property<double> high_{
      this, "High", 1.0, "the greatest value", "", component::unit_of(unit_)};
  component::InputPort<double> in_{
      this, "In", "any value", "", component::on_data<&Limit::limit>, component::unit_of(unit_)};
  component::InputPort<double> most_{this,
                                     "Most",
                                     "the greatest value without sign",
                                     "",
                                     component::may_stay_open,
                                     component::unit_of(unit_)};
  component::OutputPort<double> out_{this, "Out", "within the bounds", "",
                                     component::unit_of(unit_)};
  component::OutputPort<bool> clipped_{this, "Clipped", "whether the value was outside"};
};

}  // namespace armature::general
