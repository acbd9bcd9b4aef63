// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "armature/base/fixed_text.hpp"
#include "armature/guard/internal/watch.hpp"

namespace armature::guard {

/// A violation as it happens.
struct Sighting {
  static constexpr std::size_t kFrames = 32;

  const char* call = nullptr;
  Detail detail;
  base::FixedText<63> component;  ///< empty if none ran
  base::FixedText<63> thread;
  std::array<void*, kFrames> frames{};  ///< return addresses, innermost first
  std::size_t frame_count = 0;

  /// Equal for the same call from the same place in the same component.
  std::uint64_t key() const;
};

/// A place of a violation, with the first sighting there.
struct Place {
  std::atomic<std::uint64_t> key{0};  ///< 0: free
  std::atomic<std::uint64_t> count{0};
  std::atomic<bool> complete{false};  ///< `first` may be read
  bool printed = false;               ///< belongs to whoever prints
  Sighting first;
};

/// The distinct places of violations. Any number of threads add at once, without waiting for each
/// other and without allocating.
class Places {
 public:
  static constexpr std::size_t kCapacity = 256;

  /// True if the place was not known yet.
  bool add(const Sighting& sighting);

  std::uint64_t violations() const { return violations_.load(std::memory_order_acquire); }
  /// Violations at places for which there was no room.
  std::uint64_t elsewhere() const { return elsewhere_.load(std::memory_order_relaxed); }
  std::array<Place, kCapacity>& all() { return places_; }
  const std::array<Place, kCapacity>& all() const { return places_; }
  void clear();

 private:
  Place* find_or_claim(std::uint64_t key, bool& claimed);

  std::array<Place, kCapacity> places_{};
  std::atomic<std::uint64_t> violations_{0};
  std::atomic<std::uint64_t> elsewhere_{0};
};

}  // namespace armature::guard
