// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "armature/base/time.hpp"

namespace armature::component {

/// A value that was written, for whoever knows its type.
struct TappedSample {
  base::Time time{};             ///< of the cycle that wrote it
  std::uint64_t sequence = 0;    ///< as its writer counted it, from 1: gaps are losses
  std::vector<std::byte> value;  ///< as types::encode has it
};

/// Everything that an output port writes, or that a property becomes, on its way to a component
/// that watches it from another thread, such as a recorder. The writer never waits and is told
/// nothing: what finds no room is dropped and counted.
class Tap {
 public:
  Tap() = default;
  Tap(const Tap&) = delete;
  Tap& operator=(const Tap&) = delete;
  virtual ~Tap() = default;

  /// The oldest sample that was not taken yet; false if there is none.
  /// @thread one at a time, and none that is real-time: it allocates
  virtual bool take(TappedSample& sample) = 0;

  /// Samples that found no room since the tap was made.
  /// @thread any
  std::uint64_t dropped() const { return dropped_.load(std::memory_order_relaxed); }

 protected:
  /// @thread the writer's, of which there is one
  void count_dropped() {
    dropped_.store(dropped_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  }

 private:
  std::atomic<std::uint64_t> dropped_{0};
};

/// Of an output port; it may come and go while the application runs.
class AttachedTap : public Tap {
 public:
  /// @param sample  a `Sample` of the port's type
  /// @rt nonblocking, no allocation
  /// @thread the writer's
  virtual void push(const void* sample) noexcept = 0;

 private:
  friend class OutputPortBase;
  AttachedTap* next_ = nullptr;  ///< of those that are attached to a port
};

}  // namespace armature::component
