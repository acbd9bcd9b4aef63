// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace armature::rt {

/// What the real-time guard needs to know of the current thread. The framework keeps it true; a
/// guard that intercepts malloc and its kin reads it.
struct GuardState {
  int realtime_depth = 0;   ///< > 0: allocation and blocking are violations
  int permitted_depth = 0;  ///< > 0: they are allowed for a moment, for a stated reason
  /// Where the thread keeps what runs now (a component or nullptr), and how to name that; set once
  /// for each thread, so that switching components costs the guard nothing.
  const void* const* running = nullptr;
  const char* (*name_of)(const void* running) = nullptr;
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
