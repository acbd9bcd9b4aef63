// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "armature/platform/sockets/poller.hpp"
#include "armature/ride/transport.hpp"

namespace armature::ride::internal {

/// Where others come in: the addresses that a node listens at, and how fast they come.
/// @thread the node's
class Entrance {
 public:
  /// @param per_second  how many come in; a tenth of them at once
  Entrance(platform::Poller& poller, std::uint32_t per_second);

  /// From now on `poller` tells of it, by a key for `find`.
  const Address& add(std::unique_ptr<Listener> listener);
  /// None if `key` is of something else.
  Listener* find(std::uintptr_t key) const {
    return key < listeners_.size() ? listeners_[key].get() : nullptr;
  }
  /// One has come. To come and go costs the node more than its messages do, so what comes faster
  /// than it may waits with the operating system.
  void count(base::Time now);
  /// Nobody comes in until then.
  void pause(base::Time until);
  /// Ends a pause that is over.
  /// @return when it is to be called again
  base::Time look_at_time(base::Time now);
  void close() { listeners_.clear(); }

 private:
  void listen(bool listens);

  platform::Poller& poller_;
  const base::Duration interval_;
  std::vector<std::unique_ptr<Listener>> listeners_;
  base::Time due_{};                     ///< when the next one comes if they come evenly
  base::Time from_ = base::Time::max();  ///< if it is paused, until then
};

}  // namespace armature::ride::internal
