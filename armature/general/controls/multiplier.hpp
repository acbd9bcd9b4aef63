// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/general/controls/unit_property.hpp"

namespace armature::general {

/// Multiplies the newest values of its two inputs whenever one arrives and both were written.
class Multiplier final : public component::Component {
 public:
  using Component::Component;

 private:
  void multiply(double) {
    const auto a = a_.read();
    const auto b = b_.read();
    if (a && b) out_.write(a.value * b.value);
  }

  UnitProperty unit_a_{this, "UnitA", "of A"};
  UnitProperty unit_b_{this, "UnitB", "of B"};
  UnitProperty unit_out_{this, "UnitOut", "of the product"};
  ProductUnit product_{this, unit_out_, {&unit_a_, &unit_b_}};
  component::InputPort<double> a_{this,
                                  "A",
                                  "a factor",
                                  "",
                                  component::on_data<&Multiplier::multiply>,
                                  component::unit_of(unit_a_)};
  component::InputPort<double> b_{this,
                                  "B",
                                  "the other one",
                                  "",
                                  component::on_data<&Multiplier::multiply>,
                                  component::unit_of(unit_b_)};
  component::OutputPort<double> out_{this, "Out", "A times B", "", component::unit_of(unit_out_)};
};

}  // namespace armature::general
