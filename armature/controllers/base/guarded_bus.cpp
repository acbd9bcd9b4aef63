// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/base/guarded_bus.hpp"

#include <chrono>
#include <utility>

namespace armature::controllers {

using component::Outcome;
using guardian::Guardian;

GuardedBus::GuardedBus(component::Component* owner)
    : wanted_(owner, "guardian", Guarding::kOn,
              "a process that switches the drives off when this one dies or hangs; required: "
              "nothing runs without it") {}

Outcome GuardedBus::start(const guardian::Orders& orders) {
  guardian_.reset();
  said_.clear();
  complains_ = required_ = gone_ = loss_ = false;
  if (wanted_ == Guarding::kOff) return component::accepted();
  auto started = Guardian::start(orders);
  if (!started) return go_without(started.error());
  guardian_ = std::move(started).value();
  required_ = wanted_ == Guarding::kRequired;
  said_ = "guarded by " + guardian_->describe();
  return component::accepted();
}

Outcome GuardedBus::do_without(std::string_view why) {
  guardian_.reset();
  said_.clear();
  if (wanted_ == Guarding::kOff) return component::accepted();
  const Outcome outcome = go_without(why);
  complains_ = false;
  return outcome;
}

Outcome GuardedBus::go_without(std::string_view why) {
  said_ = "no guardian: " + std::string(why);
  complains_ = true;
  return wanted_ == Guarding::kRequired ? component::refused(said_) : component::accepted();
}

std::optional<component::Reason> GuardedBus::beat(base::Time now) {
  if (guardian_ == nullptr) return std::nullopt;
  const Guardian::Finding finding = guardian_->beat(now);
  if (finding == Guardian::Finding::kActed) {
    component::Reason why("its guardian has switched the drives off: no cycle was run for ");
    const auto silence = std::chrono::ceil<std::chrono::milliseconds>(guardian_->silence());
    char digits[24] = "";
    std::snprintf(digits, sizeof digits, "%lld ms", static_cast<long long>(silence.count()));
    return why.append(digits);
  }
  const bool gone = finding == Guardian::Finding::kGone;
  if (!std::exchange(gone_, gone) && gone) loss_ = true;
  if (gone && required_) return component::Reason("its guardian has died, and is required");
  return std::nullopt;
}

void GuardedBus::rest() {
  if (guardian_ != nullptr) guardian_->rest();
}

}  // namespace armature::controllers
