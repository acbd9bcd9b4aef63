// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/exec/watch.hpp"
#include "armature/rt/latest.hpp"

namespace armature::exec {

/// Numbers of one thread's components, which the thread copies after a cycle when it is time, for
/// another one that takes the newest copy. Nothing waits, and nothing queues.
class ThreadWatch {
 public:
  /// A copy of all of them.
  struct Picture {
    std::vector<double> values;
    std::vector<base::Time> times;
    std::uint64_t number = 0;  ///< of the pictures, from 1
  };

  /// @param interval  between two pictures at least; 0: after each cycle
  ThreadWatch(std::vector<WatchedNumber> numbers, base::Duration interval);

  /// @rt nonblocking, no allocation
  /// @thread the components', as for the next
  bool due(base::Time now) const noexcept { return now >= due_; }
  /// @rt nonblocking, no allocation, O(numbers)
  void copy(base::Time now) noexcept;

  /// The newest picture, which no writer touches until the next call; its number is 0 before the
  /// first.
  /// @thread the one that takes them
  const Picture& newest() {
    latest_.fetch();
    return latest_.value();
  }

  const std::vector<WatchedNumber>& numbers() const { return numbers_; }

 private:
  friend class Engine;

  /// Numbers of one port or property, which follow each other: what they have in common is asked
  /// for once.
  struct Run {
    std::size_t begin;
    std::size_t end;
  };
  void copy_values(const Run& run, const void* value, base::Time time) noexcept;

  std::vector<WatchedNumber> numbers_;
  std::vector<Run> runs_;
  base::Duration interval_;
  base::Duration early_;  ///< so much earlier than due is in time
  base::Time due_ = base::Time::min();
  Picture picture_;
  rt::Latest<Picture> latest_;
  ThreadWatch* next_ = nullptr;  ///< of those that an engine has; the engine's
};

}  // namespace armature::exec
