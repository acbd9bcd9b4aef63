// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/internal/entrance.hpp"

#include <algorithm>
#include <chrono>

namespace armature::ride::internal {
namespace {

constexpr base::Duration kSecond = std::chrono::seconds(1);

}  // namespace

Entrance::Entrance(platform::Poller& poller, std::uint32_t per_second)
    : poller_(poller), interval_(kSecond / std::max(per_second, 1u)) {}

const Address& Entrance::add(std::unique_ptr<Listener> listener) {
  listeners_.push_back(std::move(listener));
  poller_.add(listeners_.back()->handle(), listeners_.size() - 1, {.read = true});
  return listeners_.back()->address();
}

void Entrance::count(base::Time now) {
  due_ = std::max(due_, now) + interval_;
  const base::Time from = due_ - kSecond / 10;
  if (from > now) pause(from);
}

void Entrance::pause(base::Time until) {
  listen(false);
  from_ = until;
}

base::Time Entrance::look_at_time(base::Time now) {
  if (from_ == base::Time::max() || now < from_) return from_;
  listen(true);
  return from_ = base::Time::max();
}

void Entrance::listen(bool listens) {
  for (std::size_t key = 0; key < listeners_.size(); ++key) {
    poller_.change(listeners_[key]->handle(), key, {.read = listens});
  }
}

}  // namespace armature::ride::internal
