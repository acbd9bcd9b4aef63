// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace armature::rt {

/// What a queue of fixed capacity does with a value that it has no room for.
enum class WhenFull {
  kDropNewest,  ///< the new value is not taken, the writer is told
  kDropOldest,  ///< the oldest value makes room, the writer is told
};
/// What became of a value that was pushed.
enum class PushResult { kTaken, kRefused, kDroppedOldest };

}  // namespace armature::rt
