// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/base/time.hpp"
#include "armature/component/author.hpp"

namespace armature::controllers {

/// The period between two samples of a component. Whoever triggers it determines that, so the plan
/// knows it; the property `Period` is for what nobody periodic triggers, and is refused where it
/// says something else.
class SamplingPeriod final : public component::Checked {
 public:
  /// What a component without a period is: a mistake of the deployment, or in order unless the
  /// component says that it needs one (`expect_known`).
  enum class Need : std::uint8_t { kAlways, kIfAsked };

  explicit SamplingPeriod(component::Component* owner, Need need = Need::kAlways);

  /// The plan's, else what the property says; 0 if neither says anything.
  /// @rt nonblocking, no allocation
  base::Duration duration() const;
  double seconds() const;
  /// [s], for formulas.
  operator double() const { return seconds(); }  // NOLINT(google-explicit-constructor)

  /// Refuses a period that nobody gives, and a property that differs from the plan.
  /// @rt nonblocking, no allocation
  component::Outcome known() const;

  void check(component::Check& check) const override;
  /// What `check` says of a component that needs it.
  void expect_known(component::Check& check) const;

  /// For followers.
  component::Property<double>& property() { return property_; }

 private:
  bool given() const { return property_ > 0.0; }
  bool agrees() const;
  std::string contradiction() const;

  const component::Component& owner_;
  const Need need_;
  component::Property<double> property_;
};

/// `2 ms`, for messages.
component::Reason& append_duration(component::Reason& reason, base::Duration duration);

}  // namespace armature::controllers
