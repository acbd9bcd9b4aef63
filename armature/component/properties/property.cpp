// SPDX-License-Identifier: Apache-2.0
#include "armature/component/properties/property.hpp"

#include <charconv>
#include <type_traits>

#include "armature/base/quoted.hpp"
#include "armature/component/black_box.hpp"
#include "armature/component/host.hpp"
#include "armature/component/internal/property_tap.hpp"
#include "armature/types/elements.hpp"

namespace armature::component {

using base::quoted;

namespace {

std::optional<double> as_number(const types::Type& type, const void* data) {
  return types::with_scalar(type.kind, [data](auto of) -> std::optional<double> {
    using T = typename decltype(of)::type;
    if constexpr (std::is_same_v<T, bool>) {
      return std::nullopt;
    } else {
      return static_cast<double>(*static_cast<const T*>(data));
    }
  });
}

std::string number_text(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

}  // namespace

PropertyBase::PropertyBase(Component& owner, std::string_view name, std::string_view doc,
                           std::string_view unit, const types::Type& type, bool persistent) noexcept
    : about_(new About{owner, name, doc, unit, type, persistent}) {
  Host::declare(owner).properties.push_back(this);
}

std::string PropertyFollower::objection_to(const PropertyBase& /*property*/,
                                           const types::Value& /*value*/) const {
  return {};
}

PropertyBase::~PropertyBase() = default;

std::string_view PropertyBase::unit() const {
  return about_->unit_property != nullptr ? about_->unit_property->get() : about_->unit;
}

std::string PropertyBase::check(const types::Value& value) const {
  const std::string subject =
      "property " + quoted(about_->name) + " of " + quoted(about_->owner.name());
  if (!types::same_type(value.type(), about_->type)) {
    return subject + " is a " + about_->type.name + ", not a " + value.type().name;
  }
  if (about_->type.sealed) return subject + " is a " + about_->type.name + ", which cannot be set";
  if (!about_->limits) return {};
  bool inside = true;
  types::visit_leaves(
      about_->type, value.data(),
      [&](const std::string&, const types::Type& type, const void* data) {
        const std::optional<double> number = as_number(type, data);
        if (number && !(*number >= about_->limits->low && *number <= about_->limits->high)) {
          inside = false;
        }
      });
  if (inside) return {};
  return subject + " is " + value.text() + ", outside " + number_text(about_->limits->low) +
         " .. " + number_text(about_->limits->high) +
         (unit().empty() ? "" : " " + std::string(unit()));
}

std::string PropertyBase::objection(const types::Value& value) const {
  const bool running =
      about_->owner.state() == State::kRunning || about_->owner.state() == State::kRunTimeError;
  if (running && !about_->changeable)
    return "cannot change while the component runs; stop it first";
  for (const PropertyFollower* follower : about_->followers) {
    std::string objection = follower->objection();
    const bool changes = value.text() != types::to_text(about_->type, data());
    if (!objection.empty() && changes) return "cannot change: " + objection;
    objection = follower->objection_to(*this, value);
    if (!objection.empty()) return "cannot be " + value.text() + ": " + objection;
  }
  return {};
}

base::Result<void> PropertyBase::set(const types::Value& value) {
  if (about_->sign && value.type().kind == types::Kind::kBool) {
    return set(types::Value::of(*static_cast<const bool*>(value.data()) ? -1.0 : 1.0));
  }
  if (std::string problem = check(value); !problem.empty()) {
    return base::Error{std::move(problem)};
  }
  if (const std::string reason = objection(value); !reason.empty()) {
    return base::Error{"property " + quoted(about_->name) + " of " + quoted(about_->owner.name()) +
                       " " + reason};
  }
  types::Value copy = value;
  swap(copy);
  about_->set = true;
  if (const auto* box = Host::context(about_->owner).black_box; box != nullptr) {
    note(about_->owner, BlackBox::Note::Kind::kProperty, about_->name, value.text());
  }
  tell_followers();
  return {};
}

void PropertyBase::apply(Mandatory) noexcept {
  about_->mandatory = true;
  Host::declare(owner()).mandatory.push_back(this);
}

Tap& PropertyBase::tap(std::size_t capacity) {
  about_->taps.push_back(std::make_unique<internal::PropertyTap>(*this, capacity));
  about_->followers.push_back(about_->taps.back().get());
  return *about_->taps.back();
}

void PropertyBase::untap() {
  for (const auto& tap : about_->taps) std::erase(about_->followers, tap.get());
  about_->taps.clear();
}

void PropertyBase::tell_followers() {
  for (PropertyFollower* follower : about_->followers) follower->follow();
}

}  // namespace armature::component
