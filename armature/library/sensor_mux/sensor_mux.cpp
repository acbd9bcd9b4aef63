// SPDX-License-Identifier: Apache-2.0
#include "armature/library/sensor_mux/sensor_mux.hpp"

#include <cmath>

#include "armature/library/base/reason_text.hpp"

namespace armature::library {

using component::Outcome;
using control::Gathering;

namespace {

bool writes_to(const component::Component& writer, const component::Component& reader) {
  for (const component::OutputPortBase* output : writer.interface().outputs) {
    for (const component::InputPortBase* input : output->readers()) {
      if (&input->owner() == &reader) return true;
    }
  }
  return false;
}

}  // namespace

Outcome SensorNMux::on_start() {
  if (changes_.take()) {
    if (Outcome outcome = set_up(); !outcome) return outcome;
  }
  measured_->reset();
  missing_.reset();
  return check_order();
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

/// Refuses joints that would answer a Sample of which this component has not been told.
Outcome SensorNMux::check_order() const {
  if (sample_.source() == nullptr) return component::accepted();
  for (const component::EventHandlerBase* handler : sample_.source()->subscribers()) {
    if (handler == &sample_) break;
    const component::Component& joint = handler->component();
    if (&joint.context() != &context() || !writes_to(joint, *this)) continue;
    component::Reason why(joint.name());
    why.append(" would answer a Sample before ").append(name()).append(" hears of it: declare ");
    return component::refused(why.append(name()).append(" before ").append(joint.name()));
  }
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
  component::Reason why(writer_of(input));
  why.append(" measured ").append(input.name()).append(" = ");
  fault(append_number(why, value).append(", expected a finite number"));
}

void SensorNMux::note_missing() {
  const bool news = missing_.note(*measured_, [this](std::size_t joint) { return name_of(joint); });
  if (news) log_warning("no answer from {}: the last one is held", missing_.names());
}

}  // namespace armature::library
