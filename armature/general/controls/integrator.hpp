// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "armature/base/seconds.hpp"
#include "armature/general/controls/unit_property.hpp"

namespace armature::general {

/// Sums a value up over time, by the trapezoidal rule between the cycles in which it arrives, and
/// within bounds.
class Integrator final : public component::Component {
 public:
  using Component::Component;

 private:
  void on_check(component::Check& check) const override {
    if (low_ > high_) check.error("Low is above High", "exchange them");
  }
  component::Outcome on_start() override {
    reset();
    return component::accepted();
  }
  void reset() {
    sum_ = within(initial_);
    begun_ = false;
  }
  void add(double value) {
    if (begun_) sum_ = within(sum_ + 0.5 * (last_ + value) * base::to_seconds(time() - when_));
    begun_ = true;
    last_ = value;
    when_ = time();
    out_.write(sum_);
  }
  double within(double value) const { return std::max(low_.get(), std::min(high_.get(), value)); }

  UnitProperty unit_in_{this, "UnitIn", "of what is summed up"};
  UnitProperty unit_out_{this, "UnitOut", "of the sum, as UnitIn times s; of all bounds"};
  ProductUnit product_{this, unit_out_, {&unit_in_}, true};
  component::Property<double> initial_{
      this, "Initial", 0.0, "where it begins", "", component::unit_of(unit_out_)};
  component::Property<double> low_{
      this, "Low", -1e300, "the least sum", "", component::unit_of(unit_out_)};
  component::Property<double> high_{
      this, "High", 1e300, "the greatest sum", "", component::unit_of(unit_out_)};
  component::InputPort<double> in_{this,
                                   "In",
                                   "what is summed up",
                                   "",
                                   component::on_data<&Integrator::add>,
                                   component::unit_of(unit_in_)};
  component::OutputPort<double> out_{this, "Out", "the sum", "", component::unit_of(unit_out_)};
  component::Operation<void()> reset_{this, "reset", component::serve<&Integrator::reset>,
                                      "begins anew"};
  double sum_ = 0.0;
  double last_ = 0.0;
  base::Time when_{};
  bool begun_ = false;
};

}  // namespace armature::general
