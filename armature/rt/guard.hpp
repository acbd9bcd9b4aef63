// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace armature::rt {

/// What the real-time guard needs to know of the current thread. The framework keeps it true; a
/// guard that intercepts malloc and its kin reads it.
struct GuardState {
  int realtime_depth = 0;   ///< > 0: allocation and blocking are violations
  int permitted_depth = 0;  ///< > 0: they are allowed for a moment, for a stated reason
  /// The thread's execution context, and how to name the component that runs in it now; set once
  /// for each thread, so that switching components costs the guard nothing.
  const void* context = nullptr;
  const char* (*running_component)(const void* context) = nullptr;
};

/// The state of the calling thread; never allocates.
GuardState& guard_state() noexcept;

/// Marks the code in its scope as real-time.
class RealtimeScope {
 public:
  RealtimeScope() noexcept { ++guard_state().realtime_depth; }
  RealtimeScope(const RealtimeScope&) = delete;
  RealtimeScope& operator=(const RealtimeScope&) = delete;
  ~RealtimeScope() { --guard_state().realtime_depth; }
};

/// Lets the code in its scope allocate and block although the thread is real-time: the framework's
/// own sleeping, and the way out after an exception.
class PermitScope {
 public:
  PermitScope() noexcept { ++guard_state().permitted_depth; }
  PermitScope(const PermitScope&) = delete;
  PermitScope& operator=(const PermitScope&) = delete;
  ~PermitScope() { --guard_state().permitted_depth; }
};

}  // namespace armature::rt
