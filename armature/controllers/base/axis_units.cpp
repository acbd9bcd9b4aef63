// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/base/axis_units.hpp"

#include <utility>

#include "armature/component/host.hpp"

namespace armature::controllers {
namespace {

constexpr std::string_view kTurns = "rad";
constexpr std::string_view kMovesAlong = "m";
constexpr std::string_view kBoth = "rad or m";

std::string for_each_alternative(std::string_view unit, std::string_view turns,
                                 std::string_view moves_along) {
  if (unit == kMovesAlong) return std::string(moves_along);
  if (unit != kBoth) return std::string(turns);
  return std::string(turns).append(" or ").append(moves_along);
}

}  // namespace

std::string unit_for(std::string_view of_turning, std::string_view unit) {
  if (of_turning == "Nm") return for_each_alternative(unit, "Nm", "N");
  if (!of_turning.starts_with(kTurns)) return std::string(of_turning);
  const std::string rest(of_turning.substr(kTurns.size()));
  return for_each_alternative(unit, of_turning, std::string(kMovesAlong).append(rest));
}

/// "Nm/rad"; of what is a quotient itself "rad^-1 rad/s".
std::string gain_unit(std::string_view out, std::string_view unit, std::string_view factor) {
  const std::string behind = factor.empty() ? std::string() : " " + std::string(factor);
  if (out.find('/') == std::string_view::npos) {
    return std::string(out) + behind + "/" + std::string(unit);
  }
  const std::string before = factor.empty() ? std::string() : std::string(factor) + " ";
  return before + std::string(unit) + "^-1 " + std::string(out);
}

AxisUnit::AxisUnit(component::Component* owner, Of axes)
    : Property(owner, "Unit", std::string(kTurns),
               axes == Of::kOneAxis ? "of its position: rad, or m of a linear axis"
                                    : "of positions: rad, m of linear axes, or 'rad or m'"),
      axes_(axes) {
  add_follower(*this);
}

std::string AxisUnit::objection_to(const component::PropertyBase& /*property*/,
                                   const types::Value& value) const {
  const auto& unit = *static_cast<const std::string*>(value.data());
  const bool both = axes_ == Of::kAxes && unit == kBoth;
  if (unit == kTurns || unit == kMovesAlong || both) return {};
  return axes_ == Of::kOneAxis ? "expected rad or m" : "expected rad, m, or 'rad or m'";
}

DerivedUnit::DerivedUnit(component::Component* owner,
                         std::initializer_list<component::Property<std::string>*> sources,
                         std::function<std::string()> derive)
    : Property(owner, (*sources.begin())->name(), std::string(), ""), derive_(std::move(derive)) {
  component::Host::declare(*owner).properties.pop_back();
  assign(derive_());
  for (component::Property<std::string>* source : sources) source->add_follower(*this);
}

AxisUnits::AxisUnits(component::Component* owner, AxisUnit::Of axes)
    : position_(owner, axes),
      velocity_(owner, {&position_}, [this] { return unit_for("rad/s", position_.get()); }),
      acceleration_(owner, {&position_}, [this] { return unit_for("rad/s^2", position_.get()); }),
      jerk_(owner, {&position_}, [this] { return unit_for("rad/s^3", position_.get()); }) {}

}  // namespace armature::controllers
