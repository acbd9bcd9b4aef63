// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/sensor_mux/sensor_mux.hpp"

#include <cmath>

#include "armature/component/face.hpp"
#include "armature/component/interface.hpp"
#include "armature/controllers/base/reason_text.hpp"

namespace armature::controllers {

using component::Outcome;
using control::Gathering;

Outcome SensorNMux::on_start() {
  if (changes_.take()) {
    if (Outcome outcome = set_up(); !outcome) return outcome;
  }
  measured_->reset();
  missing_.reset();
  return component::accepted();
}

Outcome SensorNMux::set_up() {
  const auto joints = static_cast<std::size_t>(joints_.get());
  auto made =
      Gathering::make({.members = joints, .values_each = 2, .max_missing = missing_.max_missing()});
  if (!made) return component::refused(made.error());
  measured_ = std::move(made.value());
  missing_.resize(joints);
  changes_.take();
  return component::accepted();
}

void SensorNMux::sample_now() {
  const Gathering::Round round = measured_->begin();
  if (round.missing > 0) note_missing();
  if (round.overdue != Gathering::kNobody) {
    fault(missing_.give_up(round.overdue + 1, name_of(round.overdue),
                           measured_->missing_in_row(round.overdue)));
  } else if (round.complete) {
    sensor_.write(measured_->values());
  }
}

void SensorNMux::take(std::size_t joint, double value, std::size_t place) {
  if (!std::isfinite(value)) return refuse(joint, value, place);
  if (measured_->add(joint, value, place)) sensor_.write(measured_->values());
}

void SensorNMux::refuse(std::size_t joint, double value, std::size_t place) {
  const auto& input = place == kPosition ? position_[joint] : displacement_[joint];
  component::Reason why(writer_of(face(input)));
  why.append(" measured ").append(input.name()).append(" = ");
  fault(append_number(why, value).append(", expected a finite number"));
}

void SensorNMux::note_missing() {
  const bool news = missing_.note(*measured_, [this](std::size_t joint) { return name_of(joint); });
  if (news) log_warning("no answer from {} in the last round", missing_.names());
}

std::vector<const component::InputPortBase*> SensorNMux::samples_behind(
    const component::OutputPortBase& /*output*/) const {
  const auto& inputs = component::interface_of(*this).inputs;
  return {inputs.begin(), inputs.end()};
}

}  // namespace armature::controllers
