// SPDX-License-Identifier: Apache-2.0
#include "armature/component/property.hpp"

#include <charconv>
#include <cstdint>

namespace armature::component {
namespace {

std::optional<double> as_number(const types::Type& type, const void* data) {
  switch (type.kind) {
    case types::Kind::kInt8:
      return *static_cast<const std::int8_t*>(data);
    case types::Kind::kUint8:
      return *static_cast<const std::uint8_t*>(data);
    case types::Kind::kInt16:
      return *static_cast<const std::int16_t*>(data);
    case types::Kind::kUint16:
      return *static_cast<const std::uint16_t*>(data);
    case types::Kind::kInt32:
      return *static_cast<const std::int32_t*>(data);
    case types::Kind::kUint32:
      return *static_cast<const std::uint32_t*>(data);
    case types::Kind::kInt64:
      return static_cast<double>(*static_cast<const std::int64_t*>(data));
    case types::Kind::kUint64:
      return static_cast<double>(*static_cast<const std::uint64_t*>(data));
    case types::Kind::kFloat:
      return static_cast<double>(*static_cast<const float*>(data));
    case types::Kind::kDouble:
      return *static_cast<const double*>(data);
    default:
      return std::nullopt;
  }
}

std::string number_text(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::string quoted(std::string_view name) { return "'" + std::string(name) + "'"; }

}  // namespace

PropertyBase::PropertyBase(Component& owner, std::string_view name, std::string_view doc,
                           std::string_view unit, const types::Type& type, bool persistent)
    : owner_(owner), name_(name), doc_(doc), unit_(unit), type_(type), persistent_(persistent) {
  owner.declare().properties.push_back(this);
}

std::string PropertyBase::check(const types::Value& value) const {
  const std::string subject = "property " + quoted(name_) + " of " + quoted(owner_.name());
  if (!types::same_type(value.type(), type_)) {
    return subject + " is a " + type_.name + ", not a " + value.type().name;
  }
  if (!limits_) return {};
  bool inside = true;
  types::visit_leaves(type_, value.data(),
                      [&](const std::string&, const types::Type& type, const void* data) {
                        const std::optional<double> number = as_number(type, data);
                        if (number && !(*number >= limits_->low && *number <= limits_->high)) {
                          inside = false;
                        }
                      });
  if (inside) return {};
  return subject + " is " + value.text() + ", outside " + number_text(limits_->low) + " .. " +
         number_text(limits_->high) + (unit_.empty() ? "" : " " + std::string(unit_));
}

std::string PropertyBase::objection(const types::Value& value) const {
  const bool running = owner_.state() == State::kRunning || owner_.state() == State::kRunTimeError;
  if (running && !changeable_) return "cannot change while the component runs; stop it first";
  for (const PropertyFollower* follower : followers_) {
    std::string objection = follower->objection();
    const bool changes = value.text() != types::to_text(type_, data());
    if (!objection.empty() && changes) return "cannot change: " + objection;
  }
  return {};
}

base::Result<void> PropertyBase::set(const types::Value& value) {
  if (std::string problem = check(value); !problem.empty()) {
    return base::Error{std::move(problem)};
  }
  if (const std::string reason = objection(value); !reason.empty()) {
    return base::Error{"property " + quoted(name_) + " of " + quoted(owner_.name()) + " " + reason};
  }
  types::Value copy = value;
  swap(copy);
  set_ = true;
  tell_followers();
  return {};
}

void PropertyBase::tell_followers() {
  for (PropertyFollower* follower : followers_) follower->follow();
}

}  // namespace armature::component
