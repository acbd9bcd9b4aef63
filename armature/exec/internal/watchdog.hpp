// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>

#include "armature/base/time.hpp"

namespace armature::exec::internal {

/// How a series of hooks went.
struct WatchedRun {
  std::size_t done = 0;  ///< how many finished
  bool hung = false;     ///< number `done` did not finish within the limit
};

/// Runs `each(0)`, `each(1)`, ... in a thread of its own until one returns false, and gives up on
/// it if one takes longer than `limit`; what it captured must then live on.
WatchedRun run_watched(std::size_t count, base::Duration limit,
                       std::function<bool(std::size_t)> each);

}  // namespace armature::exec::internal
