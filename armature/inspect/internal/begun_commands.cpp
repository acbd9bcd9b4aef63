// SPDX-License-Identifier: Apache-2.0
#include "armature/inspect/internal/begun_commands.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace armature::inspect::internal {

bool BegunCommands::make_room() {
  if (commands_.size() < most_) return true;
  const auto ended = std::find_if(commands_.begin(), commands_.end(),
                                  [](const BegunCommand& one) { return one.state.ended(); });
  if (ended == commands_.end()) return false;
  commands_.erase(ended);
  return true;
}

const BegunCommand& BegunCommands::add(std::string name, component::CommandHandle state) {
  last_ = last_ == std::numeric_limits<std::int32_t>::max() ? 1 : last_ + 1;
  return commands_.emplace_back(BegunCommand{last_, std::move(name), std::move(state)});
}

BegunCommand* BegunCommands::find(std::int32_t handle) {
  const auto found = std::find_if(commands_.begin(), commands_.end(),
                                  [&](const BegunCommand& one) { return one.handle == handle; });
  return found == commands_.end() ? nullptr : &*found;
}

}  // namespace armature::inspect::internal
