// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "armature/base/quoted.hpp"
#include "armature/base/unit.hpp"
#include "armature/component/author.hpp"
#include "armature/component/check.hpp"

namespace armature::general {

/// The unit of a control's ports and numbers, which the deployment says: `Unit: rad`. What is no
/// unit is refused; ports and properties have it by `component::unit_of(unit)`.
class UnitProperty final : public component::Property<std::string>,
                           private component::PropertyFollower {
 public:
  UnitProperty(component::Component* owner, std::string_view name, std::string_view doc)
      : Property(owner, name, std::string(), doc) {
    add_follower(*this);
  }

 private:
  void follow() override {}
  std::string objection() const override { return {}; }
  std::string objection_to(const component::PropertyBase& property,
                           const types::Value& value) const override;
};

/// The unit of what a control computes: the check refuses another one than that of the product.
class ProductUnit final : public component::Checked {
 public:
  /// @param product  its unit, which has to be that of all of `factors` together
  /// @param times_s  whether the seconds over which it is summed up are a factor, too
  ProductUnit(component::Component* owner, const UnitProperty& product,
              std::initializer_list<const UnitProperty*> factors, bool times_s = false)
      : Checked(owner), product_(product), factors_(factors), times_s_(times_s) {}

  void check(component::Check& check) const override;

 private:
  const UnitProperty& product_;
  std::vector<const UnitProperty*> factors_;
  bool times_s_;
};

}  // namespace armature::general
