// SPDX-License-Identifier: Apache-2.0
#pragma once

// What RealtimeSanitizer (clang, preset rtsan) is to know; nothing of it is left in other builds.

/// Behind a function's parameters: everything it calls is watched by RealtimeSanitizer.
#if defined(__clang__) && __has_cpp_attribute(clang::nonblocking)
#define ARMATURE_NONBLOCKING [[clang::nonblocking]]
#else
#define ARMATURE_NONBLOCKING
#endif

#if defined(__has_feature)
#if __has_feature(realtime_sanitizer)
#define ARMATURE_INTERNAL_RTSAN
#endif
#endif

#ifdef ARMATURE_INTERNAL_RTSAN
extern "C" {
void __rtsan_realtime_enter();
void __rtsan_realtime_exit();
void __rtsan_disable();
void __rtsan_enable();
}
#endif

namespace armature::base {

/// Keeps RealtimeSanitizer quiet for the code in its scope, for a stated reason.
class SanitizerPermit {
 public:
#ifdef ARMATURE_INTERNAL_RTSAN
  SanitizerPermit() noexcept { __rtsan_disable(); }
  ~SanitizerPermit() { __rtsan_enable(); }
#else
  SanitizerPermit() noexcept {}
  ~SanitizerPermit() {}
#endif
  SanitizerPermit(const SanitizerPermit&) = delete;
  SanitizerPermit& operator=(const SanitizerPermit&) = delete;
};

namespace internal {
#ifdef ARMATURE_INTERNAL_RTSAN
inline void enter_realtime() noexcept { __rtsan_realtime_enter(); }
inline void leave_realtime() noexcept { __rtsan_realtime_exit(); }
#else
inline void enter_realtime() noexcept {}
inline void leave_realtime() noexcept {}
#endif
}  // namespace internal

}  // namespace armature::base
