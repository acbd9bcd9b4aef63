// SPDX-License-Identifier: Apache-2.0
#include "armature/general/controls/unit_property.hpp"

#include <cmath>
#include <limits>

namespace armature::general {
namespace {

std::string shown(std::string_view unit) {
  return unit.empty() ? "a plain number" : base::quoted(unit);
}

bool same(const base::Unit& a, const base::Unit& b) {
  const double most = 4.0 * std::numeric_limits<double>::epsilon();
  return a.same_kind(b) && std::abs(a.factor / b.factor - 1.0) <= most;
}

}  // namespace

std::string UnitProperty::objection_to(const component::PropertyBase& /*property*/,
                                       const types::Value& value) const {
  const auto unit = base::parse_unit(*static_cast<const std::string*>(value.data()));
  return unit ? std::string() : unit.error();
}

void ProductUnit::check(component::Check& check) const {
  const auto is = base::parse_unit(product_.get());
  base::Unit all;
  std::string text;
  for (const UnitProperty* factor : factors_) {
    const auto unit = base::parse_unit(factor->get());
    if (!unit || !is) return;  // which the property says
    for (std::size_t i = 0; i < all.powers.size(); ++i) all.powers[i] += unit.value().powers[i];
    all.factor *= unit.value().factor;
    text += (text.empty() ? "" : " times ") + shown(factor->get());
  }
  if (times_s_) {
    ++all.powers[base::Unit::kTime];
    text += " times 's'";
  }
  if (same(is.value(), all)) return;
  check.error("property " + base::quoted(product_.name()) + ": " + shown(product_.get()) +
                  " is not the unit of " + text,
              "give it the unit of the product");
}

}  // namespace armature::general
