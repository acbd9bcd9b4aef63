// SPDX-License-Identifier: Apache-2.0
#pragma once

// What shows a value to whoever looks: on a page, in the task browser, in a recording. Each takes
// what arrives, so that it shows the latest value also of another thread, and does nothing else.

#include "armature/general/controls/unit_property.hpp"

namespace armature::general {

/// Shows whether something holds.
class Light final : public component::Component {
 public:
  using Component::Component;

 private:
  void show(bool) {}
  component::InputPort<bool> on_{this,
                                 "On",
                                 "whether it shines",
                                 "",
                                 component::on_data<&Light::show>,
                                 component::leads_to_nothing()};
};

/// Shows a number.
class Number final : public component::Component {
 public:
  using Component::Component;

 private:
  void show(double) {}
  UnitProperty unit_{this, "Unit", "of the number"};
  component::InputPort<double> value_{this,
                                      "Value",
                                      "what is shown",
                                      "",
                                      component::on_data<&Number::show>,
                                      component::leads_to_nothing(),
                                      component::unit_of(unit_)};
};

/// Shows a text.
class Text final : public component::Component {
 public:
  using Component::Component;

 private:
  void show(const base::FixedText<127>&) {}
  component::InputPort<base::FixedText<127>> text_{this,
                                                   "Text",
                                                   "what is shown",
                                                   "",
                                                   component::on_data<&Text::show>,
                                                   component::leads_to_nothing()};
};

/// Shows how numbers went in the last minute.
class Plot final : public component::Component {
 public:
  using Component::Component;

 private:
  void show(std::size_t, double) {}
  UnitProperty unit_{this, "Unit", "of all curves"};
  component::Property<int> inputs_{
      this, "Inputs", 1, "how many curves", "", component::range(1, 100)};
  component::InputPorts<double> in_{this,
                                    "In",
                                    inputs_,
                                    "a curve",
                                    "",
                                    component::on_data<&Plot::show>,
                                    component::leads_to_nothing(),
                                    component::unit_of(unit_)};
};

}  // namespace armature::general
