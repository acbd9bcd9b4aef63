// SPDX-License-Identifier: Apache-2.0
#include "armature/remote/internal/peer_watches.hpp"

#include <utility>

namespace armature::remote::internal {

void PeerWatches::make_room() {
  if (watches_.size() < kMost) return;
  throw inspect::Refusal(std::to_string(kMost) +
                         " watches of other processes are kept already: end one of them");
}

void PeerWatches::add(const inspect::Watch& watch, std::set<std::string> components,
                      ride::Origin origin) {
  const std::lock_guard lock(mutex_);
  watches_.push_back({watch.handle, std::move(components), ride::Lifeline(std::move(origin))});
}

bool PeerWatches::end(std::int32_t handle) {
  const auto is_it = [handle](const PeerWatch& one) { return one.handle == handle; };
  const std::lock_guard lock(mutex_);
  if (std::erase_if(watches_, is_it) == 0) return false;
  view_.end_watch(handle);
  return true;
}

void PeerWatches::end_lost(base::Time now) {
  std::vector<std::int32_t> lost;
  for (PeerWatch& one : watches_) {
    if (one.line.lost(now)) lost.push_back(one.handle);
  }
  for (const std::int32_t handle : lost) end(handle);
}

std::set<std::string> PeerWatches::components_of(std::int32_t handle) const {
  const std::lock_guard lock(mutex_);
  for (const PeerWatch& one : watches_) {
    if (one.handle == handle) return one.components;
  }
  return {};
}

}  // namespace armature::remote::internal
