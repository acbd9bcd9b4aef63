// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros2/topic_to_port.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "armature/base/seconds.hpp"
#include "armature/component/interface.hpp"
#include "armature/component/ports/input_port.hpp"
#include "armature/component/ports/output_port.hpp"
#include "armature/types/dds_idl.hpp"
#include "bridges/ros2/internal/find_port.hpp"

namespace armature::ros2 {
namespace {

using types::Kind;

std::int64_t integer_of(const types::Type& type, const void* value) {
  const auto as = [&](auto number) {
    std::memcpy(&number, value, sizeof number);
    return static_cast<std::int64_t>(number);
  };
  switch (type.kind) {
    case Kind::kInt8:
      return as(std::int8_t{});
    case Kind::kUint8:
      return as(std::uint8_t{});
    case Kind::kInt16:
      return as(std::int16_t{});
    case Kind::kUint16:
      return as(std::uint16_t{});
    case Kind::kInt32:
      return as(std::int32_t{});
    case Kind::kUint32:
      return as(std::uint32_t{});
    default:
      return as(std::int64_t{});
  }
}

/// Whether nothing says how large the vectors are that it takes.
bool takes_any_size(const component::InputPortBase& input) {
  const types::Type& type = input.type();
  const bool declared = type.kind == Kind::kVector && input.declared_size().declared();
  return (declared ? *type.element : type).grows;
}

/// What is wrong with a value that came; empty if nothing is.
std::string objection_to_value(const types::Type& root, const void* data) {
  std::string found;
  types::visit_leaves(
      root, data, [&](const std::string& path, const types::Type& type, const void* value) {
        if (!found.empty()) return;
        const std::string where = path.empty() ? "its number" : "'" + path + "'";
        if ((type.kind == Kind::kDouble && !std::isfinite(*static_cast<const double*>(value))) ||
            (type.kind == Kind::kFloat && !std::isfinite(*static_cast<const float*>(value)))) {
          found = where + " is not finite";
        }
        if (type.kind != Kind::kEnum) return;
        const std::int64_t number = integer_of(*type.underlying, value);
        if (std::ranges::find(type.enumerators, number, &types::Enumerator::value) ==
            type.enumerators.end()) {
          found = where + " is " + std::to_string(number) + ", which no enumerator is";
        }
      });
  return found;
}

}  // namespace

void TopicToPort::on_check(component::Check& check) const {
  Subscriber::on_check(check);
  const auto* const input = written_input(check);
  if (input == nullptr) return;  // which is objected to
  if (!check.writers_of(*input).empty()) {
    check.error("'" + port_.get() + "' has a writer already", "name an input that nothing writes");
  }
  for (const component::Component* each : check.components()) {
    if (each == this) break;  // the one that comes later objects
    const auto* const other = dynamic_cast<const TopicToPort*>(each);
    if (other == nullptr || other->port_.get() != port_.get()) continue;
    check.error("'" + port_.get() + "' is written by '" + each->name() + "' already",
                "remove one of them: an input has one who commands it");
  }
}

const component::InputPortBase* TopicToPort::written_input(const component::Check& check) const {
  return internal::find_input(check.components(), port_);
}

std::vector<TopicToPort::Objection> TopicToPort::objections(const Components& components) const {
  const auto* const input = internal::find_input(components, port_);
  if (input == nullptr) {
    return {{"unknown input '" + port_.get() + "'", "name it as Component.Port"}};
  }
  if (!input->stays_open()) {
    return {{"'" + port_.get() + "' may not stay open, so its component counts on a connection",
             "name an input that may stay open, or connect a component that reads a topic"}};
  }
  if (std::string why = types::dds_objection(input->type()); !why.empty()) {
    return {{"'" + port_.get() + "' cannot be a topic: " + why, "name another port"}};
  }
  if (takes_any_size(*input)) {
    return {{"'" + port_.get() + "' takes vectors, and its component does not declare their size",
             "name an input without vectors, or one that is a vector of declared size "
             "(component::size_of); numbers come by a Float64MultiArray, which has a size"}};
  }
  return {};
}

std::string TopicToPort::open(const component::Surroundings& surroundings) {
  component::InputPortBase& input = *internal::find_input(surroundings.components, port_);
  type_ = std::make_unique<internal::DescribedType>(input.type());
  value_ = std::make_unique<types::Value>(input.type());
  writer_name_ = port_;
  if (output_ == nullptr) output_ = input.make_writer(*this, writer_name_);
  output_->prepare();
  if (!input.ages()) {
    input.set_max_age(component::max_age(base::from_seconds(max_age_), component::Reaction::kStop));
  }
  output_->connect(input, {});
  reader_ = reader(topic_, type_->descriptor(), kCommands);
  return {};
}

void TopicToPort::close() {
  reader_.reset();  // the output stays: the runtime disconnects it afterwards
  type_.reset();
  value_.reset();
}

void TopicToPort::work() {
  receive(*reader_, [this](const void* sample) { return obey(sample); });
}

std::string TopicToPort::obey(const void* sample) {
  type_->read(sample, value_->data());
  if (std::string why = objection_to_value(value_->type(), value_->data()); !why.empty()) {
    return why;
  }
  if (output_->write_from(value_->data()) == component::WriteStatus::kWrongSize) {
    return "a vector has another size than '" + port_.get() + "' takes";
  }
  return {};
}

}  // namespace armature::ros2
