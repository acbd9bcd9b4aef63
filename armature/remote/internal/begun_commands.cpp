// SPDX-License-Identifier: Apache-2.0
#include "armature/remote/internal/begun_commands.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace armature::remote::internal {

bool BegunCommands::make_room() {
  if (commands_.size() < most_) return true;
  const auto ended = std::find_if(commands_.begin(), commands_.end(), [](const BegunCommand& one) {
    return one.state.handle().ended();
  });
  if (ended == commands_.end()) return false;
  const std::lock_guard lock(mutex_);
  commands_.erase(ended);
  return true;
}

std::int32_t BegunCommands::add(std::string component, std::string command, PeerCommand state) {
  const std::lock_guard lock(mutex_);
  last_ = last_ == std::numeric_limits<std::int32_t>::max() ? 1 : last_ + 1;
  commands_.push_back({last_, std::move(component), std::move(command), std::move(state)});
  return last_;
}

BegunCommand* BegunCommands::find(std::int32_t handle) {
  const auto found = std::find_if(commands_.begin(), commands_.end(),
                                  [&](const BegunCommand& one) { return one.handle == handle; });
  return found == commands_.end() ? nullptr : &*found;
}

void BegunCommands::cancel_lost(base::Time now, const PeerCommand::Tell& tell) {
  for (BegunCommand& one : commands_) {
    one.state.cancel_if_lost(one.component + "." + one.command, now, tell);
  }
}

std::optional<std::string> BegunCommands::component_of(std::int32_t handle) const {
  const std::lock_guard lock(mutex_);
  for (const BegunCommand& one : commands_) {
    if (one.handle == handle) return one.component;
  }
  return std::nullopt;
}

}  // namespace armature::remote::internal
