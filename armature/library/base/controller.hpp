// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/library/base/max_age.hpp"

namespace armature::library {

/// The controller of a robot with N joints (paper 1, figure 4): to be extended by a control law.
class Controller : public component::Component {
 public:
  using Component::Component;

 protected:
  /// A sampling period begins; by default that is noted, to count those in which nothing was
  /// measured.
  /// Runs in real time: nonblocking, no allocation.
  /// @thread the component's own
  virtual void sample_now() {
    if (std::exchange(sampled_, true)) {
      samples_without_sensor_.assign(samples_without_sensor_ + 1);
    }
  }
  /// Computes the control signals of this sampling period and writes `act`.
  /// @param measured  [q1..qN, d1..dN] [rad]
  /// Runs in real time: nonblocking, no allocation.
  /// @thread the component's own
  virtual void controller_now(const std::vector<double>& measured) = 0;

  component::Outcome on_start() override {
    sampled_ = false;
    samples_without_sensor_.assign(0);
    return component::accepted();
  }

  component::Property<int> joints_{
      this, "joints", 1, "how many", "", component::mandatory, component::range(1, 100000)};
  component::InputPort<std::vector<double>> reference_{
      this,
      "reference",
      "desired [q1..qN, qd1..qdN, qdd1..qddN]: rad, rad/s, rad/s^2",
      "",
      component::size_of(joints_, 3),
      component::max_age(kMaxAge)};
  component::OutputPort<std::vector<double>> act_{this, "act", "control signals [u1..uN]", "V",
                                                  component::size_of(joints_)};

 private:
  void sensor_arrived(const std::vector<double>& measured) {
    sampled_ = false;
    controller_now(measured);
  }

  component::InputPort<std::vector<double>> sensor_{
      this,
      "sensor",
      "measured [q1..qN, d1..dN]: positions, then displacements since the sample before",
      "rad",
      component::on_data<&Controller::sensor_arrived>,
      component::size_of(joints_, 2),
      component::max_age(kMaxAge)};
  component::EventHandler<> sample_{this, "Sample", component::serve<&Controller::sample_now>,
                                    "a sampling period begins"};
  component::Attribute<int> samples_without_sensor_{
      this, "samples_without_sensor", 0,
      "sampling periods since the start in which nothing was measured"};
  bool sampled_ = false;
};

}  // namespace armature::library
