// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

#include "armature/base/realtime.hpp"
#include "armature/rt/outbox.hpp"

namespace armature::rt {

/// What the real-time guard needs to know of the current thread. The framework keeps it true; a
/// guard that intercepts malloc and its kin reads it.
struct GuardState {
  int realtime_depth = 0;   ///< > 0: allocation and blocking are violations
  int permitted_depth = 0;  ///< > 0: they are allowed for a moment, for a stated reason
  /// The thread's name and execution context, and how to name the component that runs in it now;
  /// set once for each thread, so that switching components costs the guard nothing.
  const char* thread = nullptr;
  const void* context = nullptr;
  const char* (*running_component)(const void* context) = nullptr;
};

/// The state of the calling thread; never allocates.
GuardState& guard_state() noexcept;

/// Marks the code in its scope as real-time, for the guard and for RealtimeSanitizer.
class RealtimeScope {
 public:
  RealtimeScope() noexcept : RealtimeScope(guard_state()) {}
  /// @param state  the calling thread's
  explicit RealtimeScope(GuardState& state) noexcept : state_(state) {
    ++state_.realtime_depth;
    // Compilers know that malloc does not look at this; the guard in front of it does.
    std::atomic_signal_fence(std::memory_order_seq_cst);
    base::internal::enter_realtime();
  }
  RealtimeScope(const RealtimeScope&) = delete;
  RealtimeScope& operator=(const RealtimeScope&) = delete;
  ~RealtimeScope() {
    base::internal::leave_realtime();
    std::atomic_signal_fence(std::memory_order_seq_cst);
    --state_.realtime_depth;
  }

 private:
  GuardState& state_;
};

/// Lets the code in its scope allocate and block although the thread is real-time: the framework's
/// own sleeping, and the way out after an exception. A driver whose calls to its hardware never
/// wait says so with it. What the thread has for others is sent before it is entered, and at once
/// while it lasts.
class PermitScope {
 public:
  PermitScope() noexcept : outbox_(Outbox::suspend()) { ++guard_state().permitted_depth; }
  PermitScope(const PermitScope&) = delete;
  PermitScope& operator=(const PermitScope&) = delete;
  ~PermitScope() {
    --guard_state().permitted_depth;
    Outbox::resume(outbox_);
  }

 private:
  Outbox* const outbox_;
  base::SanitizerPermit sanitizer_;
};

}  // namespace armature::rt
