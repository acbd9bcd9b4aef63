// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/inspect/application_view.hpp"
#include "armature/ride/origin.hpp"

namespace armature::remote::internal {

/// Watches that were begun for peers: they last no longer than the connections by which they were
/// asked for.
class PeerWatches {
 public:
  static constexpr std::size_t kMost = 16;

  explicit PeerWatches(inspect::ApplicationView& view) : view_(view) {}

  /// @throws inspect::NoAnswer  if there are too many
  /// @thread the controlling one, as for the two below
  void make_room();
  void add(const inspect::Watch& watch, std::set<std::string> components, ride::Origin origin);
  /// @return whether there was one
  bool end(std::int32_t handle);

  /// Ends those whose peers have gone, or are silent.
  /// @param now  of the monotonic clock
  /// @thread the controlling one
  void end_lost(base::Time now);

  /// The components that a watch looks into, for the policy's sake; empty if there is none.
  /// @thread any
  std::set<std::string> components_of(std::int32_t handle) const;

 private:
  struct PeerWatch {
    std::int32_t handle;
    std::set<std::string> components;
    ride::Lifeline line;
  };

  inspect::ApplicationView& view_;
  mutable std::mutex mutex_;
  std::vector<PeerWatch> watches_;  ///< changed by the controlling thread, with the lock
};

}  // namespace armature::remote::internal
