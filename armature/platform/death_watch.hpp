// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "armature/base/time.hpp"
#include "armature/platform/thread.hpp"

namespace armature::platform {

/// What ends the process from within one of its threads, which stands still from then on.
struct Death {
  /// By a signal, or by a call of `exit`.
  enum class Kind { kSignal, kExit };
  static constexpr std::size_t kMostFrames = 48;

  Kind kind = Kind::kSignal;
  int number = 0;                 ///< the signal, or the status that `exit` was called with
  const void* address = nullptr;  ///< of the memory that there is not, for SIGSEGV and SIGBUS
  bool stack_overflow = false;
  int thread = 0;                           ///< the kernel's number of it
  char thread_name[64] = "";                ///< as people know it
  char worker[64] = "";                     ///< what ran in it; empty: nothing that has a name
  const void* workplace = nullptr;          ///< of the worker, for whoever has named it
  std::array<void*, kMostFrames> frames{};  ///< return addresses, innermost first
  std::size_t frame_count = 0;

  /// Such as `segmentation fault at address 0x10`, `stack overflow`, `exit(0)`.
  std::string what() const;
};

/// Notices crashes (SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT) and calls of `exit`, in whichever
/// thread, and lets the others finish: the thread stands still, another one is told of it. After
/// five seconds, or by `conclude`, the process ends as it would have, but never with 0.
///
/// Sanitizers notice crashes themselves: in such a build only `exit` is. One at a time.
class DeathWatch {
 public:
  /// Says who works in the calling thread: fills in `thread_name`, `worker` and `workplace`. It is
  /// called by a signal handler, so it has to be async-signal-safe.
  using Namer = void (*)(Death& death);

  /// @param undertaker  called once, by a thread that is there for that
  DeathWatch(Namer namer, std::function<void(const Death&)> undertaker);
  DeathWatch(const DeathWatch&) = delete;
  DeathWatch& operator=(const DeathWatch&) = delete;
  ~DeathWatch();

  /// What has happened; nullptr: nothing yet.
  /// @thread any
  static const Death* death();
  /// Ends the process as `death` would have.
  [[noreturn]] static void conclude(const Death& death);

 private:
  std::unique_ptr<Thread> undertaker_;
};

/// Room for handlers of crashes in the thread that makes it, whose own stack may be used up. Every
/// `Thread` has one.
class CrashStack {
 public:
  CrashStack();
  CrashStack(const CrashStack&) = delete;
  CrashStack& operator=(const CrashStack&) = delete;
  ~CrashStack();

 private:
  static constexpr std::size_t kSize = 16 * 1024;
  alignas(16) std::array<char, kSize> room_;
};

/// The number of the calling thread, as `Death::thread` has it.
int thread_number();

}  // namespace armature::platform
