// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "armature/rt/atomics.hpp"
#include "armature/rt/latest.hpp"

namespace armature::rt {

/// The newest value from one writer thread to one reader thread, which travels in a batch or, while
/// none is free, by a cell and a signal.
///
/// Specification: once the batches were sent and all messages delivered, the reader has been given
/// the last value written; it is never given an older value after a newer one, nor one twice. With
/// the first message comes the newest value that the cell has by then.
///
/// @tparam T  has a member `sequence`, which the writer counts up from 1
template <typename T, typename Atomics = StdAtomics>
class Passage {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  explicit Passage(const T& initial) : received_(initial), latest_(initial) {}

  /// @param place  in a batch, nullptr if there is none
  /// @return true if it is on its way; false if the reader must be told by a signal
  /// @rt nonblocking, no allocation
  /// @thread the writer only
  bool write(const T& value, std::byte* place) {
    if (place != nullptr) {
      std::memcpy(place, &value, sizeof(T));
      return true;
    }
    latest_.write(value);
    return false;
  }

  /// What came in a batch at `data`, or a newer value; nullptr if that was here before.
  /// @rt nonblocking, no allocation
  /// @thread the reader only
  const T* receive(const std::byte* data) {
    if (const T* const newer = fetch()) return newer;
    T value;
    std::memcpy(&value, data, sizeof(T));
    if (value.sequence <= newest_) return nullptr;
    newest_ = value.sequence;
    received_ = value;
    return &received_;
  }

  /// What the signal was about; nullptr if nothing came since the last call.
  /// @rt nonblocking, no allocation
  /// @thread the reader only
  const T* fetch() {
    if (!latest_.fetch()) return nullptr;
    newest_ = latest_.value().sequence;
    return &latest_.value();
  }

 private:
  std::uint64_t newest_ = 0;  ///< that the reader was given
  T received_;
  Latest<T, Atomics> latest_;
};

}  // namespace armature::rt
