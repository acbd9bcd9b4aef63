// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <mutex>
#include <vector>

namespace armature::remote {

/// What peers ask for, on its way from a node's I/O thread to the thread that controls the
/// application, which alone may use it.
class ControlQueue {
 public:
  using Work = std::function<void()>;
  /// So much may wait; more is refused.
  static constexpr std::size_t kCapacity = 1024;

  /// @return false if the queue is full or closed: `work` is not done, and let go of
  /// @thread any
  [[nodiscard]] bool post(Work work);

  /// False if `post` would refuse.
  bool has_room() const;

  /// Does, in its order, what waited when it began.
  /// @thread the controlling one
  void run();

  /// Lets go of what waits, and takes nothing any more.
  /// @thread any
  void close();

 private:
  mutable std::mutex mutex_;
  std::vector<Work> waiting_;
  std::vector<Work> taken_;  ///< by `run`; kept for its memory
  bool closed_ = false;
};

}  // namespace armature::remote
