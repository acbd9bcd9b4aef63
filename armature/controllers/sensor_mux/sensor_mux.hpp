// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "armature/component/face.hpp"
#include "armature/control/arming/gathering.hpp"
#include "armature/controllers/base/changes.hpp"
#include "armature/controllers/base/driven_joint.hpp"
#include "armature/controllers/base/missing_answers.hpp"
#include "armature/controllers/base/sensor.hpp"

namespace armature::controllers {

/// Makes one vector of what N joints measured: writes `sensor` once all 2N values arrived after a
/// Sample (paper 1, section 3.2, SensorNMux). Equation 4 of the paper has velocities as its second
/// half; what the paper's SensorNMux is given are displacements, and so is this: in rad, since the
/// sample before. The velocity is the displacement by the period.
///
/// A joint of which not both values came by the next Sample is missing in that round: it is counted
/// and named, and the round that begins goes on in time without it, with its last position and
/// displacement. What comes from it during that round, which may be the late answer, is not taken
/// for this round's; it is waited for again from the round after (control::Gathering). If all
/// joints are missing, `sensor` is written at the Sample. A joint that never answered is waited
/// for: no zero counts as measured. After `max_missing` rounds in a row `Missing` is raised and the
/// component faults, both naming the joint; so it does at once for a value that is no finite
/// number.
/// @rt nonblocking, no allocation; O(1) for a value, O(joints) for a Sample
class SensorNMux final : public Sensor, public PassesSamples {
 public:
  using Sensor::Sensor;

  std::vector<const component::InputPortBase*> samples_behind(
      const component::OutputPortBase& output) const override;

 private:
  component::Outcome on_configure() override { return set_up(); }
  component::Outcome on_start() override;
  void sample_now() override;

  component::Outcome set_up();
  void on_position(std::size_t joint, double position) { take(joint, position, kPosition); }
  void on_displacement(std::size_t joint, double displacement) {
    take(joint, displacement, kDisplacement);
  }
  void take(std::size_t joint, double value, std::size_t place);
  void refuse(std::size_t joint, double value, std::size_t place);
  void note_missing();
  std::string_view name_of(std::size_t joint) { return writer_of(face(position_[joint])); }

  static constexpr std::size_t kPosition = 0;
  static constexpr std::size_t kDisplacement = 1;

  component::InputPorts<double> position_{this,
                                          "Position",
                                          joints_,
                                          "of each joint",
                                          "",
                                          component::on_data<&SensorNMux::on_position>,
                                          component::leads_to("sensor"),
                                          component::unit_of(units_.position())};
  component::InputPorts<double> displacement_{this,
                                              "Displacement",
                                              joints_,
                                              "of each joint since the sample before",
                                              "",
                                              component::on_data<&SensorNMux::on_displacement>,
                                              component::leads_to("sensor"),
                                              component::unit_of(units_.position())};
  MissingAnswers missing_{this};
  Changes changes_{joints_, missing_.limit()};
  std::optional<control::Gathering> measured_;
};

}  // namespace armature::controllers
