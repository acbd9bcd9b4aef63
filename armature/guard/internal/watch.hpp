// SPDX-License-Identifier: Apache-2.0
#pragma once

// How the guard stands in front of a function of the C library.

#include <atomic>
#include <cstddef>
#include <string_view>

#include "armature/base/fixed_text.hpp"
#include "armature/rt/guard.hpp"

namespace armature::rt {
// The guard works in processes without the runtime too.
[[gnu::weak]] GuardState& guard_state() noexcept;
}  // namespace armature::rt

namespace armature::guard {

/// What a call was asked to do, for people.
using Detail = base::FixedText<79>;

Detail number(std::string_view before, std::size_t value, std::string_view after = {});
Detail bytes(std::size_t count);
Detail file(int descriptor);
Detail file(int descriptor, std::size_t count);
Detail path(const char* name);

/// Where the runtime keeps a thread's GuardState, seen from the thread pointer; 0: there is no
/// runtime. The same in every thread (the variable is `initial-exec`): looking costs one load.
inline constinit std::ptrdiff_t state_offset = 0;

/// True if the calling thread must not allocate or block now.
inline bool watched() {
  if (state_offset == 0) return false;
  const auto* const thread = static_cast<const std::byte*>(__builtin_thread_pointer());
  const auto* const state = reinterpret_cast<const rt::GuardState*>(thread + state_offset);
  return state->realtime_depth > 0 && state->permitted_depth == 0;
}

/// Takes note of a call that does not belong on a real-time thread, or aborts.
/// @param caller  the return address of the call
void note_violation(const char* call, const Detail& detail, const void* caller);

/// > 0: what happens on this thread is the guard's own doing.
inline constinit thread_local int own_business = 0;

class OwnBusiness {
 public:
  OwnBusiness() { ++own_business; }
  OwnBusiness(const OwnBusiness&) = delete;
  OwnBusiness& operator=(const OwnBusiness&) = delete;
  ~OwnBusiness() { --own_business; }
};

/// The function `name` of the library behind the guard; aborts if there is none.
void* find_next(const char* name);

template <typename Function>
Function* next(std::atomic<Function*>& known, const char* name) {
  Function* function = known.load(std::memory_order_relaxed);
  if (function == nullptr) [[unlikely]] {
    function = reinterpret_cast<Function*>(find_next(name));
    known.store(function, std::memory_order_relaxed);
  }
  return function;
}

/// Prints what was noted and not printed yet. Called where a thread that is not real-time is about
/// to sleep anyway: it has the time that the violator has not.
void print_news();

/// Prints what was not printed yet, and a summary: the process ends.
void print_end();

}  // namespace armature::guard

#define ARMATURE_GUARD_EXPORT extern "C" __attribute__((visibility("default")))

/// Begins the definition of the function `name` as others see it, and leads to the one behind. The
/// label keeps it apart from the system's declaration with its attributes.
#define ARMATURE_GUARD_FUNCTION(result, name, parameters)                \
  ARMATURE_GUARD_EXPORT result guarded_##name parameters __asm__(#name); \
  result guarded_##name parameters

#define ARMATURE_GUARD_NOTE(name, ...)                                                          \
  if (::armature::guard::watched()) [[unlikely]]                                                \
    [=](const void* caller) __attribute__((noinline, cold)) {                                   \
      ::armature::guard::note_violation(#name, ::armature::guard::Detail{__VA_ARGS__}, caller); \
    }                                                                                           \
  (__builtin_return_address(0))

/// Defines the function `name`: notes the call if the thread is watched, then calls the function
/// behind. What follows `arguments` is the detail of the call.
#define ARMATURE_GUARD(result, name, parameters, arguments, ...)        \
  ARMATURE_GUARD_FUNCTION(result, name, parameters) {                   \
    static constinit std::atomic<result(*) parameters> behind{nullptr}; \
    ARMATURE_GUARD_NOTE(name, __VA_ARGS__);                             \
    return ::armature::guard::next(behind, #name) arguments;            \
  }

/// The same for a function that sleeps.
#define ARMATURE_GUARD_SLEEP(result, name, parameters, arguments)       \
  ARMATURE_GUARD_FUNCTION(result, name, parameters) {                   \
    static constinit std::atomic<result(*) parameters> behind{nullptr}; \
    ARMATURE_GUARD_NOTE(name);                                          \
    ::armature::guard::print_news();                                    \
    return ::armature::guard::next(behind, #name) arguments;            \
  }
