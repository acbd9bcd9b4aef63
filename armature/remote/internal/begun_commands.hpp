// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <string>

#include "armature/base/time.hpp"
#include "armature/remote/internal/peer_command.hpp"

namespace armature::remote::internal {

/// A command that was begun for a peer.
struct BegunCommand {
  std::int32_t handle;
  std::string component;
  std::string command;
  PeerCommand state;
};

/// The commands that were begun and may be asked for, by their handles.
class BegunCommands {
 public:
  explicit BegunCommands(std::size_t most) : most_(most) {}

  /// Makes room for one more by forgetting the oldest that has ended; false if all are under way.
  /// @thread the controlling one
  bool make_room();
  /// @return its handle, which is given once
  /// @thread the controlling one, after `make_room`
  std::int32_t add(std::string component, std::string command, PeerCommand state);
  /// nullptr if it was forgotten, or never was.
  /// @thread the controlling one; valid until the next `make_room`
  BegunCommand* find(std::int32_t handle);
  /// Cancels those whose peers are gone.
  /// @thread the controlling one
  void cancel_lost(base::Time now, const PeerCommand::Tell& tell);
  /// The component that it was given to.
  /// @thread any
  std::optional<std::string> component_of(std::int32_t handle) const;

 private:
  const std::size_t most_;
  mutable std::mutex mutex_;
  std::deque<BegunCommand> commands_;  ///< changed by the controlling thread, with the lock
  std::int32_t last_ = 0;
};

}  // namespace armature::remote::internal
