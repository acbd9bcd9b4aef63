// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "armature/base/seconds.hpp"
#include "armature/general/controls/unit_property.hpp"

namespace armature::general {

/// A number that somebody moves, within bounds. With `Hold` it is there only as long as somebody
/// holds it, which is told by moving it again and again: what is let go of, or whose holder has
/// gone, is at `Rest` again after `Release`. Jogging needs that: a lost connection moves nothing.
class Slider final : public component::Component {
 public:
  using Component::Component;

 private:
  void on_check(component::Check& check) const override {
    if (!(low_ <= rest_ && rest_ <= high_)) {
      check.error("Rest is not between Low and High", "give it a value from Low to High");
    }
  }
  component::Outcome on_start() override {
    value_ = rest_;
    return component::accepted();
  }
  void on_update() override {
    if (hold_ && base::to_seconds(time() - moved_) > release_) value_ = rest_;
    out_.write(value_);
  }
  component::Outcome move(double value) {
    if (value != value) return component::refused("it is moved to a number, not to NaN");
    value_ = std::max(low_.get(), std::min(high_.get(), value));
    moved_ = time();
    out_.write(value_);
    move_.complete();
    return component::accepted();
  }

  UnitProperty unit_{this, "Unit", "of the number and of all bounds"};
  component::Property<double> low_{
      this, "Low", 0.0, "the least number", "", component::unit_of(unit_)};
  component::Property<double> high_{
      this, "High", 1.0, "the greatest number", "", component::unit_of(unit_)};
  component::Property<double> rest_{
      this, "Rest",
      0.0,  "where it is at the start, and with Hold when nobody holds it",
      "",   component::unit_of(unit_)};
  component::Property<bool> hold_{this, "Hold", false, "whether it goes back when it is let go of"};
  component::Property<double> release_{this, "Release",
                                       0.15, "for so long it is held without being moved",
                                       "s",  component::range(0.0, 60.0)};
  component::OutputPort<double> out_{this, "Out", "where it is", "", component::unit_of(unit_)};
  component::Command<double> move_{this, "move", component::serve<&Slider::move>,
                                   "moves it, at most to a bound", component::args("value")};
  double value_ = 0.0;
  base::Time moved_ = base::Time::min();
};

}  // namespace armature::general
