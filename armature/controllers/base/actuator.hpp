// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/controllers/base/axis_units.hpp"
#include "armature/controllers/base/max_age.hpp"
#include "armature/controllers/base/sample_input.hpp"

namespace armature::controllers {

/// The actuators of a robot with N joints (paper 1, figure 4): to be extended by what drives them.
class Actuator : public component::Component {
 public:
  /// @param unit  of its control signals; a literal
  explicit Actuator(std::string name, std::string_view unit = "V")
      : Component(std::move(name)), unit_(unit) {}

 protected:
  /// A sampling period begins; by default that is noted, for `take_sample`.
  /// Runs in real time: nonblocking, no allocation.
  /// @thread the component's own
  virtual void sample_now() {
    if (std::exchange(sampled_, true)) samples_without_act_.assign(samples_without_act_ + 1);
  }
  /// Drives the joints.
  /// @param act  one control signal per joint
  /// Runs in real time: nonblocking, no allocation.
  /// @thread the component's own
  virtual void actuate(const std::vector<double>& act) = 0;

  /// Whether a sampling period began since this was asked last.
  bool take_sample() { return std::exchange(sampled_, false); }

  component::Outcome on_start() override {
    sampled_ = false;
    samples_without_act_.assign(0);
    return component::accepted();
  }

  component::Property<int> joints_{
      this, "joints", 1, "number of joints", "", component::mandatory, component::range(1, 100000)};
  AxisUnit axes_unit_{this, AxisUnit::Of::kAxes};

 private:
  std::string_view unit_;  ///< of axes that turn

 protected:
  DerivedUnit signals_unit_{
      this, {&axes_unit_}, [this] { return unit_for(unit_, axes_unit_.get()); }};

 private:
  component::InputPort<std::vector<double>> act_{this,
                                                 "act",
                                                 "control signals [u1..uN]",
                                                 "",
                                                 component::unit_of(signals_unit_),
                                                 component::on_data<&Actuator::actuate>,
                                                 component::size_of(joints_),
                                                 component::max_age(kMaxAge)};
  component::EventHandler<> sample_{this, "Sample", component::serve<&Actuator::sample_now>,
                                    "a sampling period begins", component::optional};
  component::InputPort<std::uint64_t> sample_port_{
      this,
      "SamplePort",
      "the same from a port, as in paper 3: the number of the sample",
      "",
      component::on_data<&Actuator::sample_now>,
      component::may_stay_open,
      component::on_lost(component::Reaction::kHold)};
  SampleInput sample_input_{this, sample_, sample_port_};
  component::Attribute<int> samples_without_act_{
      this, "samples_without_act", 0,
      "sampling periods since the start in which nothing was driven"};
  bool sampled_ = false;
};

}  // namespace armature::controllers
