// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/base/sampling_period.hpp"

#include <chrono>
#include <cmath>

#include "armature/base/seconds.hpp"
#include "armature/controllers/base/reason_text.hpp"

namespace armature::controllers {

using component::Pace;
using component::Reason;

namespace {

/// Of what is written with a few digits.
constexpr double kSame = 1e-6;

std::string text_of(base::Duration duration) {
  Reason text;
  return std::string(append_duration(text, duration).view());
}

std::string runs(const Pace& pace) {
  std::string text = "'" + pace.owner->name() + "' runs it every " + text_of(pace.period);
  if (!pace.ambiguous()) return text;
  return text + ", and '" + pace.other_owner->name() + "' every " + text_of(pace.other);
}

}  // namespace

Reason& append_duration(Reason& reason, base::Duration duration) {
  return append_number(reason, std::chrono::duration<double, std::milli>(duration).count())
      .append(" ms");
}

SamplingPeriod::SamplingPeriod(component::Component* owner, Need need)
    : Checked(owner),
      owner_(*owner),
      need_(need),
      property_(owner, "Period", 0.0,
                "between two samples; 0: that of the component that triggers it", "s",
                component::range(0.0, 60.0)) {}

base::Duration SamplingPeriod::duration() const {
  return owner_.pace().known() ? owner_.period() : base::from_seconds(property_);
}

double SamplingPeriod::seconds() const { return base::to_seconds(duration()); }

bool SamplingPeriod::agrees() const {
  const Pace& pace = owner_.pace();
  const auto equals = [this](base::Duration period) {
    return std::abs(property_ - base::to_seconds(period)) <= kSame * property_;
  };
  return !given() || pace.owner == nullptr || equals(pace.period) ||
         (pace.ambiguous() && equals(pace.other));
}

component::Outcome SamplingPeriod::known() const {
  if (!agrees()) {
    Reason why("Period is ");
    append_duration(why, base::from_seconds(property_)).append(", but it is run every ");
    return component::refused(append_duration(why, owner_.pace().period));
  }
  if (duration() > base::Duration::zero()) return component::accepted();
  return component::refused("the period between two samples is not known: set Period");
}

std::string SamplingPeriod::contradiction() const {
  const Pace& pace = owner_.pace();
  return "Period is " + text_of(base::from_seconds(property_)) + ", but " + runs(pace);
}

void SamplingPeriod::check(component::Check& check) const {
  if (!agrees()) {
    return check.error(contradiction(),
                       "leave Period out, or give '" + owner_.pace().owner->name() +
                           "' activity: {periodic: " + text_of(base::from_seconds(property_)) +
                           "}");
  }
  if (need_ == Need::kAlways) expect_known(check);
}

void SamplingPeriod::expect_known(component::Check& check) const {
  if (given() || owner_.pace().known()) return;
  if (owner_.pace().ambiguous()) {
    check.error("needs one period between two samples, but " + runs(owner_.pace()),
                "let only one of them trigger it, or set Period to the one that counts");
  } else {
    check.error("needs the period between two samples, but no periodic component triggers it",
                "give the component that samples it activity: {periodic: 10 ms}, or set its "
                "property Period");
  }
}

}  // namespace armature::controllers
