// SPDX-License-Identifier: Apache-2.0
#include "armature/studio/internal/seat.hpp"

#include <algorithm>
#include <utility>

namespace armature::studio::internal {
namespace {

std::string name_of(const Seat::Guest& guest) {
  return "browser " + std::to_string(guest.number) + " (" + guest.who + ")";
}

}  // namespace

Seat::State Seat::state(const ride::Origin& guest, bool may_operate) {
  const std::scoped_lock lock(mutex_);
  forget_lost();
  Known* known = find(guest);
  if (known == nullptr) {
    changed_ = true;
    known_.push_back({{++last_number_, guest.who(), may_operate}, guest, ride::Lifeline(guest)});
    known = &known_.back();
  }
  State state{known->guest.number, holder_, {}};
  for (const Known& one : known_) state.guests.push_back(one.guest);
  return state;
}

base::Result<void> Seat::take(const ride::Origin& guest) {
  const std::scoped_lock lock(mutex_);
  forget_lost();
  const Known* const known = find(guest);
  if (known == nullptr) return base::Error{"ask for the seat's state first"};
  if (const Known* const other = sitting(); other != nullptr && other != known) {
    return base::Error{name_of(other->guest) +
                       " sits at the operator's seat: ask there for it to be handed over"};
  }
  sit(known->guest.number);
  return {};
}

base::Result<void> Seat::hand_over(const ride::Origin& guest, std::int32_t to) {
  const std::scoped_lock lock(mutex_);
  forget_lost();
  if (const auto sits_there = sits(guest); !sits_there) return sits_there;
  const auto next =
      std::ranges::find(known_, to, [](const Known& one) { return one.guest.number; });
  if (next == known_.end()) {
    return base::Error{"browser " + std::to_string(to) + " is not there: choose one that is"};
  }
  if (!next->guest.may_operate) {
    return base::Error{name_of(next->guest) + " may not command: choose one that may"};
  }
  sit(to);
  return {};
}

base::Result<void> Seat::leave(const ride::Origin& guest) {
  const std::scoped_lock lock(mutex_);
  if (const auto sits_there = sits(guest); !sits_there) return sits_there;
  sit(0);
  return {};
}

base::Result<base::Duration> Seat::hold_key(const ride::Origin& guest, bool down, base::Time now) {
  const std::scoped_lock lock(mutex_);
  if (const auto sits_there = sits(guest); !sits_there) return base::Error{sits_there.error()};
  if (down) return key_.renew(now);
  key_.release();
  return base::Duration{};
}

base::Result<void> Seat::demand(const ride::Origin& guest) {
  const std::scoped_lock lock(mutex_);
  forget_lost();
  return sits(guest);
}

base::Result<void> Seat::use_key(const ride::Origin& guest, base::Time now) {
  const std::scoped_lock lock(mutex_);
  forget_lost();
  if (const auto sits_there = sits(guest); !sits_there) return sits_there;
  return key_.use(now);
}

bool Seat::look(base::Time now) {
  const std::scoped_lock lock(mutex_);
  const auto gone = std::erase_if(known_, [now](Known& one) { return one.line.lost(now); });
  changed_ = changed_ || gone > 0;
  forget_lost();
  return std::exchange(changed_, false);
}

std::int32_t Seat::holder() const {
  const std::scoped_lock lock(mutex_);
  return holder_;
}

Seat::Known* Seat::find(const ride::Origin& guest) {
  const auto found = std::ranges::find(known_, guest, &Known::origin);
  return found == known_.end() ? nullptr : &*found;
}

const Seat::Known* Seat::sitting() const {
  const auto found =
      std::ranges::find(known_, holder_, [](const Known& one) { return one.guest.number; });
  return found == known_.end() ? nullptr : &*found;
}

void Seat::sit(std::int32_t number) {
  if (holder_ == number) return;
  holder_ = number;
  key_ = {};
  changed_ = true;
}

void Seat::forget_lost() {
  const auto gone = std::erase_if(known_, [](const Known& one) { return one.origin.lost(); });
  changed_ = changed_ || gone > 0;
  if (sitting() == nullptr) sit(0);
}

base::Result<void> Seat::sits(const ride::Origin& guest) const {
  const Known* const there = sitting();
  if (there != nullptr && there->origin == guest) return {};
  if (there == nullptr) return base::Error{"nobody sits at the operator's seat: take it first"};
  return base::Error{name_of(there->guest) +
                     " sits at the operator's seat: ask there for it to be handed over"};
}

}  // namespace armature::studio::internal
