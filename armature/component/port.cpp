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

InputPortBase::InputPortBase(Component& owner, std::string name, std::string_view doc,
                             std::string_view unit, const types::Type& type)
    : PortBase(owner, std::move(name), doc, unit, type),
      entrance_(owner, this->name()),
      lost_(*this) {}

void InputPortBase::begin() {
  started_ = owner().time();
  late_ = false;
  zeroed_ = false;
}

void InputPortBase::check_age() {
  const bool ages = max_age_ > base::Duration::zero() && connected();
  if (!ages || owner().state() != State::kRunning) return;
  look_for_newer();
  const bool was_late = std::exchange(late_, is_stale(written()));
  if (!late_ || was_late) return;
  ++counters_.stale;
  if (stale_reaction_ != Reaction::kZero) react(stale_reaction_, "its data is older than declared");
}

base::Time InputPortBase::written() const {
  return current_sequence() == 0 ? started_ : std::max(current_time(), started_);
}

base::Time InputPortBase::expiry() const {
  const bool ages = max_age_ > base::Duration::zero() && connected() && !late_;
  return ages ? written() + max_age_ + base::Duration(1) : base::Time::max();
}

void InputPortBase::Lost::deliver(rt::Message& message) {
  auto& lost = static_cast<Lost&>(message);
  lost.lower();
  ++lost.self.counters_.lost;
  lost.self.react(lost.self.lost_reaction_, "the component that writes it is out of service");
}

void InputPortBase::react(Reaction reaction, std::string_view what) {
  if (owner().state() != State::kRunning && owner().state() != State::kRunTimeError) return;
  Reason reason("input '");
  reason.append(name()).append("': ").append(what);
  switch (reaction) {
    case Reaction::kHold:
      break;
    case Reaction::kZero:
      zeroed_ = true;
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
