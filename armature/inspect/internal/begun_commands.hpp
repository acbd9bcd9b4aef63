// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>

#include "armature/component/operations/command.hpp"

namespace armature::inspect::internal {

/// A command that was begun.
struct BegunCommand {
  std::int32_t handle;
  std::string name;
  component::CommandHandle state;
};

/// The commands that were begun and may be asked for, by their handles.
class BegunCommands {
 public:
  explicit BegunCommands(std::size_t most) : most_(most) {}

  /// Makes room for one more by forgetting the oldest that has ended; false if all are under way.
  bool make_room();
  /// The command with a handle that is given once. To be called after `make_room`.
  const BegunCommand& add(std::string name, component::CommandHandle state);
  /// nullptr if it was forgotten, or never was; valid until the next `make_room`.
  BegunCommand* find(std::int32_t handle);

 private:
  const std::size_t most_;
  std::deque<BegunCommand> commands_;
  std::int32_t last_ = 0;
};

}  // namespace armature::inspect::internal
