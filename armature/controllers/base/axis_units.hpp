// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>

#include "armature/component/author.hpp"

namespace armature::controllers {

/// The unit of an axis' positions, or of those of several: `Unit: m` of one that moves along a
/// line, `Unit: rad or m` of axes of both kinds.
class AxisUnit final : public component::Property<std::string>,
                       private component::PropertyFollower {
 public:
  /// Whether it may be both.
  enum class Of { kOneAxis, kAxes };

  AxisUnit(component::Component* owner, Of axes);

 private:
  void follow() override {}
  std::string objection() const override { return {}; }
  std::string objection_to(const component::PropertyBase& property,
                           const types::Value& value) const override;

  const Of axes_;
};

/// A unit that follows from others of the component, such as m/s from m. It is no property that
/// tools see: they see its text, as the unit of what has it by `component::unit_of`.
class DerivedUnit final : public component::Property<std::string>,
                          private component::PropertyFollower {
 public:
  /// @param sources  whose first has its name, so that a deployment sets that one first
  DerivedUnit(component::Component* owner,
              std::initializer_list<component::Property<std::string>*> sources,
              std::function<std::string()> derive);

 private:
  void follow() override { assign(derive_()); }
  std::string objection() const override { return {}; }

  std::function<std::string()> derive_;
};

/// The unit of positions, and those that follow from it; "rad/s or m/s" of axes of both kinds.
class AxisUnits {
 public:
  AxisUnits(component::Component* owner, AxisUnit::Of axes);

  const AxisUnit& position() const { return position_; }
  AxisUnit& position() { return position_; }
  const DerivedUnit& velocity() const { return velocity_; }
  const DerivedUnit& acceleration() const { return acceleration_; }
  const DerivedUnit& jerk() const { return jerk_; }

 private:
  AxisUnit position_;
  DerivedUnit velocity_;
  DerivedUnit acceleration_;
  DerivedUnit jerk_;
};

/// What is in `of_turning` for an axis that turns, for axes in `unit`: N for Nm, m/s for rad/s; the
/// same where it does not depend on that, as V.
std::string unit_for(std::string_view of_turning, std::string_view unit);

/// Of a gain that makes `out` of what is in `unit`, with another factor such as "s".
std::string gain_unit(std::string_view out, std::string_view unit, std::string_view factor = {});

}  // namespace armature::controllers
