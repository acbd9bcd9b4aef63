// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "armature/component/face.hpp"
#include "armature/controllers/base/driven_joint.hpp"
#include "armature/controllers/base/max_age.hpp"
#include "armature/controllers/base/sampling_period.hpp"
#include "armature/controllers/base/sensor.hpp"

namespace armature::wam {

/// The sensors of the arm (paper 3, SensorWAM): asks its peer WamHardware for a reading at each
/// Sample, and makes `sensor` of what comes.
/// @rt nonblocking but for the hardware's reading, no allocation, O(joints)
class SensorWam final : public controllers::Sensor, public controllers::PassesSamples {
 public:
  using Sensor::Sensor;

  std::vector<const component::InputPortBase*> samples_behind(
      const component::OutputPortBase& /*output*/) const override {
    return {&face(data_)};
  }

 private:
  using Vector = std::vector<double>;

  component::Outcome on_configure() override;
  void sample_now() override;
  void on_data(const Vector& data);

  controllers::SamplingPeriod period_{this};
  component::OperationCaller<bool()> read_{this, "getJointSensorsOperation",
                                           "has the sensors read"};
  component::InputPort<Vector> data_{this,
                                     "InputSensorPort",
                                     "[q1..qN, qd1..qdN, tau1..tauN]",
                                     "",
                                     component::on_data<&SensorWam::on_data>,
                                     component::size_of(joints_, 3),
                                     component::max_age(controllers::kMaxAge),
                                     component::leads_to("sensor")};
  component::Attribute<int> unread_{this, "samples_without_data", 0,
                                    "Samples since the configuration in which nothing was read"};
  Vector measured_;
};

}  // namespace armature::wam
