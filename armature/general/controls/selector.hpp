// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/general/controls/unit_property.hpp"

namespace armature::general {

/// Passes on one of its inputs, as it arrives: the one that `Selected`, or `select`, says.
class Selector final : public component::Component {
 public:
  using Component::Component;

 private:
  void pass(std::size_t index, double value) {
    if (index + 1 == static_cast<std::size_t>(selected_)) out_.write(value);
  }
  component::Outcome select(int number) {
    if (number < 1 || number > inputs_) {
      return component::refused("no input has this number: they count from 1 to Inputs");
    }
    selected_.assign(number);
    select_.complete();
    return component::accepted();
  }

  UnitProperty unit_{this, "Unit", "of all ports"};
  component::Property<int> inputs_{this, "Inputs", 2, "how many", "", component::range(1, 1000)};
  component::Property<int> selected_{this,
                                     "Selected",
                                     1,
                                     "the number of the input that counts; none passes nothing on",
                                     "",
                                     component::range(0, 1000),
                                     component::changeable_while_running};
  component::InputPorts<double> in_{this,
                                    "In",
                                    inputs_,
                                    "one of them is passed on",
                                    "",
                                    component::on_data<&Selector::pass>,
                                    component::unit_of(unit_)};
  component::OutputPort<double> out_{this, "Out", "what came by the selected input", "",
                                     component::unit_of(unit_)};
  component::Command<int> select_{this, "select", component::serve<&Selector::select>,
                                  "has another input count", component::args("number")};
};

}  // namespace armature::general
