// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/ride/origin.hpp"

namespace armature::studio::internal {

/// Commands of a run that clients have begun: as of every peer, they last no longer than the
/// connection by which they were asked for.
/// @thread any
class BegunCommands {
 public:
  /// It is under way.
  void add(std::int32_t handle, const ride::Origin& client);
  /// It is so no more.
  void end(std::int32_t handle);

  /// Those whose clients have gone, or are silent: to be cancelled. What cannot be cancelled after
  /// many tries is not known to the run any more.
  /// @param now  of the monotonic clock
  std::vector<std::int32_t> lost(base::Time now);
  /// The next ones, of all in turn, to be asked whether they have ended.
  std::vector<std::int32_t> next(std::size_t most);

 private:
  struct Begun {
    std::int32_t handle;
    ride::Lifeline line;
    int tries = 0;  ///< to cancel it
  };
  static constexpr int kMostTries = 100;

  std::mutex mutex_;  ///< of the next
  std::vector<Begun> begun_;
};

}  // namespace armature::studio::internal
