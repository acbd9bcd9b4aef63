// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace armature::rt {

/// A picture of a `Distribution` at one moment.
struct DistributionSummary {
  std::uint64_t count = 0;
  std::uint64_t total = 0;
  std::uint64_t least = 0;
  std::uint64_t most = 0;
  std::array<std::uint64_t, 256> buckets{};

  double mean() const {
    return count == 0 ? 0.0 : static_cast<double>(total) / static_cast<double>(count);
  }
  /// The value that `share` (0..1) of all are not above, to within 1/4 of its size.
  std::uint64_t percentile(double share) const;
};

/// How often which duration occurred: four buckets for each power of two. One thread adds, any
/// thread looks.
class Distribution {
 public:
  /// @rt nonblocking, no allocation, a few nanoseconds
  /// @thread one only
  void add(std::uint64_t value) {
    bump(total_, value, std::memory_order_relaxed);
    if (value > most_.load(std::memory_order_relaxed)) {
      most_.store(value, std::memory_order_relaxed);
    }
    if (value < least_.load(std::memory_order_relaxed)) {
      least_.store(value, std::memory_order_relaxed);
    }
    // Last, so that whoever counts the value finds it between `least` and `most`.
    bump(buckets_[bucket_of(value)], 1, std::memory_order_release);
  }

  DistributionSummary summary() const;

  /// The bucket of a value, and the largest value of a bucket.
  static constexpr std::size_t bucket_of(std::uint64_t value) {
    if (value < 4) return static_cast<std::size_t>(value);
    const auto exponent = static_cast<int>(std::bit_width(value)) - 1;
    const auto quarter = static_cast<std::size_t>((value >> (exponent - 2)) & 3u);
    return static_cast<std::size_t>(exponent - 1) * 4 + quarter;
  }
  static constexpr std::uint64_t upper_bound_of(std::size_t bucket) {
    if (bucket < 4) return bucket;
    const auto exponent = static_cast<int>(bucket / 4) + 1;
    const std::uint64_t step = std::uint64_t{1} << (exponent - 2);
    return (4 + bucket % 4) * step + (step - 1);
  }

 private:
  using Counter = std::atomic<std::uint64_t>;
  static void bump(Counter& counter, std::uint64_t by, std::memory_order order) {
    // One writer: a plain addition, visible to readers, without a locked instruction.
    counter.store(counter.load(std::memory_order_relaxed) + by, order);
  }

  Counter total_{0};
  Counter most_{0};
  Counter least_{~std::uint64_t{0}};
  std::array<Counter, 256> buckets_{};
};

}  // namespace armature::rt
