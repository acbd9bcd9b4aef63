// SPDX-License-Identifier: Apache-2.0
#include "armature/rt/outbox.hpp"

#include <algorithm>
#include <utility>

#include "armature/rt/wakeup.hpp"

namespace armature::rt {

constinit thread_local Outbox* Outbox::current_ = nullptr;

Outbox::Scope::Scope(Outbox& outbox) noexcept : before_(std::exchange(current_, &outbox)) {}

Outbox::Scope::~Scope() {
  flush_outbox();
  current_ = before_;
}

Outbox* Outbox::suspend() noexcept {
  flush_outbox();
  return std::exchange(current_, nullptr);
}

void Outbox::begin(Lane& lane, Wakeup& reader) noexcept {
  send_gathered();
  gathering_ = &lane;
  reader_ = &reader;
}

void Outbox::send_gathered() noexcept {
  if (gathering_ == nullptr) return;
  std::exchange(gathering_, nullptr)->send();
  owe(*reader_);
}

void Outbox::owe(Wakeup& wakeup) noexcept {
  const auto end = owed_.begin() + static_cast<std::ptrdiff_t>(count_);
  if (std::find(owed_.begin(), end, &wakeup) != end) return;
  if (count_ == kMost) notify_all();
  owed_[count_++] = &wakeup;
}

void Outbox::notify_all() noexcept {
  for (std::size_t i = 0; i < count_; ++i) owed_[i]->notify();
  count_ = 0;
}

void Outbox::flush() noexcept {
  send_gathered();
  notify_all();
}

void notify_soon(Wakeup& wakeup) noexcept {
  if (Outbox* const mine = Outbox::current()) {
    mine->owe(wakeup);
  } else {
    wakeup.notify();
  }
}

}  // namespace armature::rt
