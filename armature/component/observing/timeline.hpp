// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "armature/base/time.hpp"
#include "armature/rt/ring.hpp"

namespace armature::component {

class Component;

/// What one thread did when, on its way to whoever writes it down in another thread. In simulated
/// time those that take turns in one thread share one.
///
/// A stretch is a cycle, or the handling of messages between two cycles; steps are what components
/// did within one. To take the time of each step costs more than many a step takes, so it is done
/// as long as it stays within a share of the thread's time; a stretch itself costs next to nothing
/// and is kept unless even that is too much.
class Timeline {
 public:
  /// One record: a stretch opens or closes, or a step within it ends.
  struct Entry {
    /// What the record says.
    enum class Kind : std::uint8_t { kOpen, kStep, kClose };
    Kind kind = Kind::kOpen;
    std::uint16_t thread = 0;              ///< kOpen: whoever does it
    bool cycle = false;                    ///< kClose: a cycle, else messages between cycles
    bool detailed = false;                 ///< kClose: with its steps
    std::uint32_t missing = 0;             ///< kOpen: stretches before this one that were not kept
    const Component* component = nullptr;  ///< kStep
    std::uint64_t begin = 0;               ///< kOpen, kStep: tick; kClose: the cycle's number
    std::uint64_t end = 0;                 ///< kStep, kClose: tick
    base::Time time{};                     ///< kOpen: on the clock; kClose: the cycle time
  };

  /// How much is kept, and how much time that may take.
  struct Limits {
    std::size_t capacity = 1024;  ///< entries that wait for their reader
    double share = 0.1;           ///< of the thread's time, in the long run
    base::Duration burst{};       ///< of its time at once
  };
  explicit Timeline(const Limits& limits);

  /// @rt nonblocking, no allocation
  /// @thread the observed one, as all that follow
  void open(std::uint16_t thread, base::Time now, std::uint64_t tick) noexcept;
  /// True if the steps of the cycle that was just opened may be timed.
  /// @rt nonblocking, no allocation
  bool affords_steps() const noexcept { return kept_ && budget_ >= steps_cost_; }
  /// @rt nonblocking, no allocation
  void add_step(const Component* ran, std::uint64_t begin, std::uint64_t end) noexcept {
    if (!kept_ || ran == nullptr) return;
    if (step_.component == ran && step_.end == begin) {
      step_.end = end;
      return;
    }
    finish_step();
    step_.component = ran;
    step_.begin = begin;
    step_.end = end;
  }
  /// @rt nonblocking, no allocation
  void close(std::uint64_t tick, std::uint64_t number, base::Time cycle_time, bool cycle,
             bool detailed) noexcept;
  /// Other work for the timeline was done at this thread's expense.
  /// @rt nonblocking, no allocation
  void spend(std::uint64_t ticks) noexcept { budget_ -= static_cast<std::int64_t>(ticks); }

  /// Entries so far.
  /// @rt nonblocking, no allocation
  std::uint64_t pushed() const noexcept { return pushed_; }
  std::size_t capacity() const { return ring_.capacity(); }

  /// The oldest entry that was not taken yet, nullptr if there is none; valid until the next call.
  /// @thread the reader's
  const Entry* pop() { return ring_.pop(); }
  /// Entries that found no room.
  /// @thread any
  std::uint64_t dropped() const { return dropped_.load(std::memory_order_relaxed); }

 private:
  void finish_step() noexcept {
    if (step_.component == nullptr) return;
    ++steps_;
    push(step_);
    step_.component = nullptr;
  }
  bool push(const Entry& entry) noexcept;

  // [ticks]
  const std::int64_t burst_;
  const std::int64_t stretch_cost_;
  const std::int64_t step_cost_;
  const double share_;
  std::int64_t budget_;
  std::int64_t steps_cost_ = 0;  ///< of the last cycle with steps
  std::uint64_t earned_until_ = 0;
  std::int64_t steps_ = 0;
  std::uint64_t pushed_ = 0;
  std::uint32_t missing_ = 0;
  bool kept_ = false;
  Entry step_{.kind = Entry::Kind::kStep};
  std::atomic<std::uint64_t> dropped_{0};
  rt::Ring<Entry> ring_;
};

}  // namespace armature::component
