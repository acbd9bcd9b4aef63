// SPDX-License-Identifier: Apache-2.0
#include "armature/component/port.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "armature/component/input_port.hpp"
#include "armature/component/output_port.hpp"

namespace armature::component {

std::string_view name_of(ReadStatus status) {
  switch (status) {
    case ReadStatus::kNotConnected:
      return "not connected";
    case ReadStatus::kNone:
      return "none";
    case ReadStatus::kOld:
      return "old";
    case ReadStatus::kNew:
      return "new";
  }
  return "unknown";
}

std::string_view name_of(Reaction reaction) {
  switch (reaction) {
    case Reaction::kHold:
      return "hold";
    case Reaction::kZero:
      return "zero";
    case Reaction::kStop:
      return "stop";
    case Reaction::kFault:
      return "fault";
  }
  return "unknown";
}

bool LeadsTo::includes(std::string_view name) const {
  if (!declared) return true;
  for (const std::string_view each : names) {
    if (each.empty() || name.substr(0, each.size()) != each) continue;
    // The rest may only be the number of a port in an array.
    if (name.find_first_not_of("0123456789", each.size()) == std::string_view::npos) return true;
  }
  return false;
}

void InputPortBase::begin() {
  about().started = owner().time();
  about().late = false;
  set(kZeroed, false);
}

void InputPortBase::check_age() {
  if (!has(kAges) || !connected() || owner().state() != State::kRunning) return;
  look_for_newer();
  About& mine = about();
  const bool was_late = std::exchange(mine.late, is_stale(written()));
  if (!mine.late || was_late) return;
  ++mine.counters.stale;
  if (mine.stale_reaction != Reaction::kZero) {
    react(mine.stale_reaction, "its data is older than declared");
  }
}

base::Time InputPortBase::written() const {
  return current_sequence() == 0 ? about().started : std::max(current_time(), about().started);
}

base::Time InputPortBase::expiry() const {
  const bool ages = has(kAges) && connected() && !about().late;
  return ages ? written() + about().max_age + base::Duration(1) : base::Time::max();
}

void InputPortBase::Lost::deliver(rt::Message& message) {
  auto& lost = static_cast<Lost&>(message);
  lost.lower();
  About& about = lost.self.about();
  ++about.counters.lost;
  lost.self.react(about.lost_reaction, "the component that writes it is out of service");
}

void InputPortBase::react(Reaction reaction, std::string_view what) {
  if (owner().state() != State::kRunning && owner().state() != State::kRunTimeError) return;
  Reason reason("input '");
  reason.append(name()).append("': ").append(what);
  switch (reaction) {
    case Reaction::kHold:
      break;
    case Reaction::kZero:
      set(kZeroed, true);
      break;
    case Reaction::kStop:
      owner().stop_because(reason);
      break;
    case Reaction::kFault:
      owner().fault(reason);
      break;
  }
}

namespace internal {

void set_to_zero(const types::Type& type, void* value) {
  if (type.set_text != nullptr) {
    type.set_text(value, {});
  } else if (type.element != nullptr) {
    const bool vector = type.kind == types::Kind::kVector;
    const std::size_t count = vector ? type.vector_size(value) : type.count;
    auto* element = static_cast<std::byte*>(vector ? type.vector_data(value) : value);
    for (std::size_t i = 0; i < count; ++i, element += type.element->size) {
      set_to_zero(*type.element, element);
    }
  } else if (type.kind == types::Kind::kStruct) {
    for (const types::Field& field : type.fields) {
      set_to_zero(*field.type, static_cast<std::byte*>(value) + field.offset);
    }
  } else {
    std::memset(value, 0, type.size);
  }
}

void forget_reader(OutputPortBase& writer, InputPortBase& reader) { writer.forget(reader); }

}  // namespace internal
}  // namespace armature::component
