// SPDX-License-Identifier: Apache-2.0
#include "armature/studio/internal/begun_commands.hpp"

#include <algorithm>

namespace armature::studio::internal {

void BegunCommands::add(std::int32_t handle, const ride::Origin& client) {
  const std::scoped_lock lock(mutex_);
  begun_.push_back({handle, ride::Lifeline(client)});
}

void BegunCommands::end(std::int32_t handle) {
  const std::scoped_lock lock(mutex_);
  std::erase_if(begun_, [handle](const Begun& one) { return one.handle == handle; });
}

std::vector<std::int32_t> BegunCommands::lost(base::Time now) {
  const std::scoped_lock lock(mutex_);
  std::vector<std::int32_t> handles;
  for (Begun& one : begun_) {
    if (!one.line.lost(now)) continue;
    ++one.tries;
    handles.push_back(one.handle);
  }
  std::erase_if(begun_, [](const Begun& one) { return one.tries > kMostTries; });
  return handles;
}

std::vector<std::int32_t> BegunCommands::next(std::size_t most) {
  const std::scoped_lock lock(mutex_);
  const std::size_t count = std::min(most, begun_.size());
  std::vector<std::int32_t> handles;
  for (std::size_t i = 0; i < count; ++i) handles.push_back(begun_[i].handle);
  std::rotate(begun_.begin(), begun_.begin() + static_cast<std::ptrdiff_t>(count), begun_.end());
  return handles;
}

}  // namespace armature::studio::internal
