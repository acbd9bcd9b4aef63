// SPDX-License-Identifier: Apache-2.0
#include "armature/control/arming/gathering.hpp"

#include <algorithm>

#include "armature/control/internal/mistakes.hpp"

namespace armature::control {

base::Result<void> Gathering::check(const Config& config) {
  internal::Mistakes mistakes("Gathering");
  mistakes.expect(config.members >= 1, "members", static_cast<double>(config.members),
                  "at least 1");
  mistakes.expect(config.values_each >= 1, "values_each", static_cast<double>(config.values_each),
                  "at least 1");
  mistakes.expect(config.max_missing >= 1, "max_missing", config.max_missing, "at least 1");
  return mistakes.result();
}

base::Result<Gathering> Gathering::make(const Config& config) {
  if (const auto checked = check(config); !checked) return base::Error{checked.error()};
  return Gathering(config);
}

Gathering::Gathering(const Config& config)
    : config_(config),
      members_(config.members),
      arrived_in_(config.members * config.values_each),
      arriving_(arrived_in_.size()),
      values_(arrived_in_.size()) {}

Gathering::Round Gathering::begin() {
  Round round;
  const bool all_answered = awaited_ == 0 && !any_held_;
  if (round_ > 0) {
    for (std::size_t i = 0; i < members_.size(); ++i) judge(i, round);
    if (!all_answered) {
      for (std::size_t i = 0; i < members_.size(); ++i) publish(i);
    }
  }
  ++round_;
  wait_for_all_but_held();
  round.complete = awaited_ == 0;
  return round;
}

/// Whether it answered in the round that ends, and so whether the next one waits for it.
void Gathering::judge(std::size_t index, Round& round) {
  Member& member = members_[index];
  if (member.outstanding == 0) {
    member.answered = true;
    member.missing_in_row = 0;
    return;
  }
  ++round.missing;
  ++member.missing_ever;
  ++member.missing_in_row;
  if (member.missing_in_row >= config_.max_missing && round.overdue == kNobody) {
    round.overdue = index;
  }
}

/// The values of a member that answered are what will be held for it.
void Gathering::publish(std::size_t member) {
  if (members_[member].outstanding > 0) return;
  for (std::size_t i = member; i < values_.size(); i += members_.size()) values_[i] = arriving_[i];
}

void Gathering::publish() {
  if (!any_held_) {
    std::copy(arriving_.begin(), arriving_.end(), values_.begin());
    return;
  }
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (!members_[i].held) publish(i);
  }
}

void Gathering::wait_for_all_but_held() {
  awaited_ = 0;
  any_held_ = false;
  for (Member& member : members_) {
    member.held = member.answered && member.missing_in_row > 0;
    member.outstanding = config_.values_each;
    any_held_ = any_held_ || member.held;
    if (!member.held) awaited_ += config_.values_each;
  }
}

void Gathering::reset() {
  round_ = 0;
  awaited_ = 0;
  any_held_ = false;
  std::fill(members_.begin(), members_.end(), Member{});
  std::fill(arrived_in_.begin(), arrived_in_.end(), 0);
  std::fill(arriving_.begin(), arriving_.end(), 0.0);
  std::fill(values_.begin(), values_.end(), 0.0);
}

}  // namespace armature::control
