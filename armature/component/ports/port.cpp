// SPDX-License-Identifier: Apache-2.0
#include "armature/component/ports/port.hpp"

#include <utility>

#include "armature/component/internal/port_parts.hpp"

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

bool LeadsTo::includes(std::string_view name) const {
  if (!declared) return true;
  for (const std::string_view each : names) {
    if (each.empty() || name.substr(0, each.size()) != each) continue;
    // The rest may only be the number of a port in an array.
    if (name.find_first_not_of("0123456789", each.size()) == std::string_view::npos) return true;
  }
  return false;
}

PortBase::About::About(const PortDeclaration& declaration)
    : name(declaration.name),
      form(declaration.type),
      is_small(declaration.is_small),
      unit(declaration.unit),
      doc(declaration.doc) {}

PortBase::About::~About() = default;

PortBase::PortBase(Component& owner, std::unique_ptr<About> about) noexcept
    : owner_(owner), about_(std::move(about)) {}

PortBase::~PortBase() = default;

const std::string& PortBase::name() const { return about_->name; }

std::string_view PortBase::doc() const { return about_->doc; }

std::string_view PortBase::unit() const {
  return about_->unit_property != nullptr ? about_->unit_property->get() : about_->unit;
}

const Property<std::string>* PortBase::unit_property() const { return about_->unit_property; }

const types::Type& PortBase::type() const { return about_->form.type(); }

const PortSize& PortBase::declared_size() const { return about_->size; }

bool PortBase::stays_open() const { return about_->may_stay_open; }

void PortBase::apply(PortSize size) noexcept { about_->size = size; }

void PortBase::apply(UnitOf unit) noexcept { about_->unit_property = unit.property; }

void PortBase::follow_unit_of(const PortBase& other) noexcept {
  about_->unit = other.about_->unit;
  about_->unit_property = other.about_->unit_property;
}

void PortBase::apply(MayStayOpen) noexcept { about_->may_stay_open = true; }

}  // namespace armature::component
