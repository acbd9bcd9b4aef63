// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "armature/general/controls/unit_property.hpp"

namespace armature::general {

/// Adds the newest values of its inputs, each with its sign or weight, whenever one arrives and all
/// were written.
class Adder final : public component::Component {
 public:
  using Component::Component;

 private:
  component::Outcome on_configure() override {
    const auto inputs = static_cast<std::size_t>(inputs_);
    weights_.assign(inputs, 1.0);
    if (signs_.get().empty()) return component::accepted();
    if (signs_.get().size() != inputs) {
      return component::refused("Signs has another length than there are inputs: give each one");
    }
    weights_ = signs_;
    return component::accepted();
  }
  void add(std::size_t, double) {
    double sum = 0.0;
    for (std::size_t i = 0; i < in_.size(); ++i) {
      const auto reading = in_[i].read();
      if (!reading) return;
      sum += weights_[i] * reading.value;
    }
    out_.write(sum);
  }

  UnitProperty unit_{this, "Unit", "of all ports"};
  component::Property<int> inputs_{this, "Inputs", 2, "how many", "", component::range(1, 1000)};
  component::Property<std::vector<double>> signs_{
      this, "Signs", {}, "of each input, 1 or -1, or its weight; empty: 1"};
  component::InputPorts<double> in_{this,
                                    "In",
                                    inputs_,
                                    "what is added",
                                    "",
                                    component::on_data<&Adder::add>,
                                    component::unit_of(unit_)};
  component::OutputPort<double> out_{this, "Out", "the sum", "", component::unit_of(unit_)};
  std::vector<double> weights_;
};

}  // namespace armature::general
