// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <vector>

#include "armature/component/author.hpp"

namespace armature {

/// What a volt moves joint `number` in a period, and where it begins.
inline double gain_of(int number) { return 0.002 * (1.0 + 0.1 * (number % 7)); }
inline double initial_of(int number) { return 0.02 * (number % 5); }

/// A joint without hardware, with the ports of Joint that the cycle needs: the voltage applied at
/// Act moves it by `gain_of` rad/V until the next Sample.
class FakeJoint final : public component::Component {
 public:
  using Component::Component;

 private:
  component::Outcome on_start() override {
    samples_ = 0;
    applied_ = 0.0;
    q_ = initial_of(number_);
    return component::accepted();
  }
  void on_sample() {
    const double displacement = gain_of(number_) * applied_;
    q_ += displacement;
    ++samples_;
    const auto& silent = silent_in_.get();
    if (std::find(silent.begin(), silent.end(), samples_) != silent.end()) return;
    displacement_.write(displacement);
    position_.write(q_);
  }
  void on_act() { applied_ = voltage_.read().value; }

  component::Property<int> number_{this, "number", 1, "of the joint"};
  component::Property<std::vector<int>> silent_in_{this, "silent_in", {}, "samples, from 1"};
  component::EventHandler<> sample_{this, "Sample", component::serve<&FakeJoint::on_sample>,
                                    "measures", component::leads_to("Position", "Displacement")};
  component::EventHandler<> act_{this, "Act", component::serve<&FakeJoint::on_act>, "drives",

                                 component::leads_to_nothing()};
  component::InputPort<double> voltage_{this, "Voltage", "to apply at Act", "V"};
  component::OutputPort<double> displacement_{this, "Displacement", "since the sample before",
                                              "rad"};
  component::OutputPort<double> position_{this, "Position", "of the joint", "rad"};

  int samples_ = 0;
  double applied_ = 0.0;
  double q_ = 0.0;
};

}  // namespace armature
