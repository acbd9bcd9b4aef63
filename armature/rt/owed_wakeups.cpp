// SPDX-License-Identifier: Apache-2.0
#include "armature/rt/owed_wakeups.hpp"

#include <algorithm>
#include <utility>

#include "armature/rt/guard.hpp"
#include "armature/rt/wakeup.hpp"

namespace armature::rt {
namespace {

OwedWakeups*& account() noexcept {
  [[gnu::tls_model("initial-exec")]] static thread_local OwedWakeups* open = nullptr;
  return open;
}

}  // namespace

OwedWakeups::Account::Account(OwedWakeups& owed) noexcept
    : before_(std::exchange(account(), &owed)) {}

OwedWakeups::Account::~Account() {
  pay_owed_wakeups();
  account() = before_;
}

void OwedWakeups::owe(Wakeup& wakeup) noexcept {
  const auto end = owed_.begin() + static_cast<std::ptrdiff_t>(count_);
  if (std::find(owed_.begin(), end, &wakeup) != end) return;
  if (count_ == kMost) pay();
  owed_[count_++] = &wakeup;
}

void OwedWakeups::pay() noexcept {
  for (std::size_t i = 0; i < count_; ++i) owed_[i]->notify();
  count_ = 0;
}

void notify_soon(Wakeup& wakeup) noexcept {
  OwedWakeups* const mine = account();
  if (mine == nullptr || guard_state().permitted_depth > 0) {
    wakeup.notify();
  } else {
    mine->owe(wakeup);
  }
}

void pay_owed_wakeups() noexcept {
  if (OwedWakeups* const mine = account()) mine->pay();
}

}  // namespace armature::rt
