// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "armature/rt/guard.hpp"

namespace armature::testing {

/// Counts what does not belong on a real-time thread, in all threads of the process, as long as it
/// lives: `EXPECT_EQ(guard.violations(), 0) << guard.report();`. One at a time.
///
/// Under AddressSanitizer and ThreadSanitizer it sees allocation only; under RealtimeSanitizer it
/// counts nothing, because that one ends the process at the first violation.
class RealtimeGuard {
 public:
  /// Throws std::logic_error if the guard is not in front of the C library, and so sees nothing.
  RealtimeGuard();
  RealtimeGuard(const RealtimeGuard&) = delete;
  RealtimeGuard& operator=(const RealtimeGuard&) = delete;
  ~RealtimeGuard();

  std::uint64_t violations() const;
  /// Each place once: the call, the component, the thread, how often, and the call stack.
  std::string report() const;

  /// Runs `code` as a real-time thread would; returns the violations up to now.
  template <typename Code>
  std::uint64_t watch(Code&& code) {
    {
      const rt::RealtimeScope realtime;
      std::forward<Code>(code)();
    }
    return violations();
  }
};

}  // namespace armature::testing
