// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/controllers/base/axis_units.hpp"
#include "armature/controllers/base/sample_input.hpp"

namespace armature::controllers {

/// The sensors of a robot with N joints (paper 1, figure 4): to be extended by what reads them.
class Sensor : public component::Component {
 public:
  using Component::Component;

 protected:
  /// A sampling period begins; by default that is noted, for `take_sample`. What extends it reads
  /// the sensors here, or has them read, and writes `sensor`.
  /// Runs in real time: nonblocking, no allocation.
  /// @thread the component's own
  virtual void sample_now() { sampled_ = true; }

  /// Whether a sampling period began since this was asked last; for those that leave `sample_now`
  /// as it is.
  bool take_sample() { return std::exchange(sampled_, false); }

  component::Outcome on_start() override {
    sampled_ = false;
    return component::accepted();
  }

  AxisUnits units_{this, AxisUnit::Of::kAxes};
  component::Property<int> joints_{
      this, "joints", 1, "number of joints", "", component::mandatory, component::range(1, 100000)};
  component::OutputPort<std::vector<double>> sensor_{
      this,
      "sensor",
      "measured [q1..qN, d1..dN]: positions, then displacements since the sample before",
      "",
      component::size_of(joints_, 2),
      component::unit_of(units_.position())};

 private:
  component::EventHandler<> sample_{this, "Sample", component::serve<&Sensor::sample_now>,
                                    "a sampling period begins", component::optional};
  component::InputPort<std::uint64_t> sample_port_{
      this,
      "SamplePort",
      "the same from a port, as in paper 3: the number of the sample",
      "",
      component::on_data<&Sensor::sample_now>,
      component::may_stay_open,
      component::on_lost(component::Reaction::kHold)};
  SampleInput sample_input_{this, sample_, sample_port_};
  bool sampled_ = false;
};

}  // namespace armature::controllers
