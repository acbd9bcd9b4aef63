// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "armature/base/time.hpp"

namespace armature::component {

class Component;

/// What one cycle of a thread did, step by step, for whoever asked for it in another thread. It is
/// handed over twice: empty to the thread, and full back.
class CycleRecord {
 public:
  /// A component ran, without what it called.
  struct Step {
    const Component* component = nullptr;
    std::uint64_t begin = 0;  ///< [ticks]
    std::uint64_t end = 0;    ///< [ticks]
  };

  /// @param most_steps  those for which there is room
  explicit CycleRecord(std::size_t most_steps) : steps_(most_steps) {}

  /// @rt nonblocking, no allocation
  /// @thread the recorded one, as for the next two
  void open(std::uint64_t number, base::Time time, std::uint64_t tick) noexcept {
    number_ = number;
    time_ = time;
    begin_ = tick;
    count_ = 0;
    left_out_ = 0;
  }
  /// @rt nonblocking, no allocation
  void add_step(const Component* ran, std::uint64_t begin, std::uint64_t end) noexcept;
  /// Nothing comes after it.
  /// @rt nonblocking, no allocation
  void close(std::uint64_t tick) noexcept {
    end_ = tick;
    full_.store(true, std::memory_order_release);
  }

  /// Whether the thread has handed it back. What follows is good only then.
  /// @thread the one that asked, as for the rest
  bool full() const { return full_.load(std::memory_order_acquire); }
  void empty() { full_.store(false, std::memory_order_relaxed); }

  std::uint64_t number() const { return number_; }  ///< of the thread's cycles, from 1
  base::Time time() const { return time_; }         ///< that components were told
  std::uint64_t begin() const { return begin_; }    ///< [ticks]
  std::uint64_t end() const { return end_; }        ///< [ticks]
  std::size_t count() const { return count_; }      ///< of the steps
  const Step& step(std::size_t index) const { return steps_[index]; }
  std::uint64_t left_out() const { return left_out_; }  ///< steps that found no room

 private:
  std::vector<Step> steps_;
  std::size_t count_ = 0;
  std::uint64_t left_out_ = 0;
  std::uint64_t number_ = 0;
  base::Time time_{};
  std::uint64_t begin_ = 0;
  std::uint64_t end_ = 0;
  std::atomic<bool> full_{false};
};

}  // namespace armature::component
