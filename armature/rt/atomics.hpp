// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>

namespace armature::rt {

/// The atomics that the wait-free structures are built from, and the plain variables that change
/// hands between threads. Every structure takes them as a parameter, so that the model checker runs
/// the very same code with its own.
struct StdAtomics {
  template <typename T>
  using Atomic = std::atomic<T>;
  template <typename T>
  using Plain = T;
};

/// For a structure that only one thread uses: the same code, without atomic instructions.
struct PlainAtomics {
  template <typename T>
  using Plain = T;
  /// An atomic variable as a plain one.
  template <typename T>
  class Atomic {
   public:
    Atomic() = default;
    explicit Atomic(T value) : value_(value) {}
    T load(std::memory_order) const { return value_; }
    void store(T value, std::memory_order) { value_ = value; }
    T exchange(T value, std::memory_order) {
      const T old = value_;
      value_ = value;
      return old;
    }
    bool compare_exchange_strong(T& expected, T desired, std::memory_order, std::memory_order) {
      if (value_ != expected) {
        expected = value_;
        return false;
      }
      value_ = desired;
      return true;
    }

   private:
    T value_{};
  };
};

inline constexpr std::size_t kCacheLine = 64;

}  // namespace armature::rt
