// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/death_watch.hpp"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <iterator>
#include <utility>

#include <execinfo.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <sys/eventfd.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "armature/platform/internal/direct_calls.hpp"

namespace armature::platform {
namespace {

constexpr int kCrashes[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
constexpr int kFailed = 1;
/// For all others to finish.
constexpr int kPatienceMs = 5000;

[[maybe_unused]] struct sigaction previous[std::size(kCrashes)];
std::atomic<bool> watching{false};
std::atomic<bool> claimed{false};
std::atomic<bool> told{false};
DeathWatch::Namer name_worker = nullptr;
int wake_descriptor = -1;
constinit Death the_death;

/// The lowest address of the thread's stack; nullptr if it has no CrashStack.
[[gnu::tls_model("initial-exec")]] thread_local const char* lowest_of_stack = nullptr;
[[gnu::tls_model("initial-exec")]] thread_local bool dying = false;

[[noreturn]] void die_by(int signal) {
  struct sigaction action {};
  action.sa_handler = SIG_DFL;
  ::sigaction(signal, &action, nullptr);
  sigset_t only;
  sigemptyset(&only);
  sigaddset(&only, signal);
  ::pthread_sigmask(SIG_UNBLOCK, &only, nullptr);
  // To the process: the others must not go on either.
  ::kill(::getpid(), signal);
  ::raise(signal);
  ::_exit(128 + signal);
}

void stand_still(int milliseconds) {
  timespec time{milliseconds / 1000, milliseconds % 1000 * 1'000'000L};
  while (::nanosleep(&time, &time) != 0 && errno == EINTR) {
  }
}

/// A little beyond the end of a stack is where the next variable would have been.
bool is_beyond_stack(const void* address) {
  constexpr std::ptrdiff_t kFar = 256 * 1024;
  constexpr std::ptrdiff_t kInside = 4096;
  if (lowest_of_stack == nullptr || address == nullptr) return false;
  const std::ptrdiff_t above = static_cast<const char*>(address) - lowest_of_stack;
  return above < kInside && above > -kFar;
}

/// The thread that comes first tells of it; those that come later stand still.
[[noreturn]] void bury(Death::Kind kind, int number, const void* address) {
  dying = true;
  while (claimed.exchange(true)) stand_still(1000);
  the_death.kind = kind;
  the_death.number = number;
  the_death.address = address;
  the_death.stack_overflow = is_beyond_stack(address);
  the_death.thread = thread_number();
  if (name_worker != nullptr) name_worker(the_death);
  the_death.frame_count = static_cast<std::size_t>(
      ::backtrace(the_death.frames.data(), static_cast<int>(the_death.frames.size())));
  told.store(true, std::memory_order_release);
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = ::write(wake_descriptor, &one, sizeof one);
  stand_still(kPatienceMs);
  DeathWatch::conclude(the_death);
}

[[maybe_unused]] void on_crash(int signal, siginfo_t* info, void*) {
  // Not even what is to be said can be done.
  if (dying) die_by(signal);
  const bool of_memory = signal == SIGSEGV || signal == SIGBUS;
  bury(Death::Kind::kSignal, signal, of_memory ? info->si_addr : nullptr);
}

void on_exit_of_process(int status, void*) {
  if (watching) bury(Death::Kind::kExit, status, nullptr);
}

void at_quick_exit_of_process() {
  if (watching) bury(Death::Kind::kExit, 0, nullptr);
}

/// These cannot be taken back.
void watch_exits() {
  static const bool once = [] {
    ::on_exit(on_exit_of_process, nullptr);
    std::at_quick_exit(at_quick_exit_of_process);
    return true;
  }();
  static_cast<void>(once);
}

void watch_crashes() {
#ifndef ARMATURE_PLATFORM_SANITIZED
  void* frame = nullptr;
  ::backtrace(&frame, 1);  // loads the unwinder, which allocates
  struct sigaction action {};
  action.sa_sigaction = on_crash;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK | SA_NODEFER;
  sigemptyset(&action.sa_mask);
  for (std::size_t i = 0; i < std::size(kCrashes); ++i) {
    ::sigaction(kCrashes[i], &action, &previous[i]);
  }
#endif
}

void leave_crashes() {
#ifndef ARMATURE_PLATFORM_SANITIZED
  for (std::size_t i = 0; i < std::size(kCrashes); ++i) {
    ::sigaction(kCrashes[i], &previous[i], nullptr);
  }
#endif
}

std::string name_of(int signal) {
  switch (signal) {
    case SIGSEGV:
      return "segmentation fault";
    case SIGBUS:
      return "bus error";
    case SIGFPE:
      return "arithmetic error";
    case SIGILL:
      return "illegal instruction";
    case SIGABRT:
      return "abort";
    default:
      return "signal " + std::to_string(signal);
  }
}

}  // namespace

std::string Death::what() const {
  if (kind == Kind::kExit) return "exit(" + std::to_string(number) + ")";
  if (stack_overflow) return "stack overflow";
  if (number != SIGSEGV && number != SIGBUS) return name_of(number);
  char text[32];
  std::snprintf(text, sizeof text, "0x%zx", reinterpret_cast<std::size_t>(address));
  return name_of(number) + " at address " + text;
}

DeathWatch::DeathWatch(Namer namer, std::function<void(const Death&)> undertaker) {
  name_worker = namer;
  claimed = false;
  told = false;
  the_death = Death{};
  wake_descriptor = ::eventfd(0, EFD_CLOEXEC);
  ThreadRequest request;
  request.name = "undertaker";
  request.stack_bytes = 256 * 1024;
  request.prefault = false;
  undertaker_ = std::make_unique<Thread>(request, [undertaker = std::move(undertaker)] {
    std::uint64_t count = 0;
    while (::read(wake_descriptor, &count, sizeof count) < 0 && errno == EINTR) {
    }
    if (told.load(std::memory_order_acquire)) undertaker(the_death);
  });
  watch_exits();
  watch_crashes();
  watching = true;
}

DeathWatch::~DeathWatch() {
  watching = false;
  leave_crashes();
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = ::write(wake_descriptor, &one, sizeof one);
  undertaker_->join();
  ::close(wake_descriptor);
}

const Death* DeathWatch::death() {
  return told.load(std::memory_order_acquire) ? &the_death : nullptr;
}

void DeathWatch::conclude(const Death& death) {
  if (death.kind == Death::Kind::kSignal) die_by(death.number);
  ::_exit(death.number != 0 ? death.number : kFailed);
}

CrashStack::CrashStack() {
  stack_t stack{};
  stack.ss_sp = room_.data();
  stack.ss_size = room_.size();
  ::sigaltstack(&stack, nullptr);
  pthread_attr_t attributes;
  if (::pthread_getattr_np(::pthread_self(), &attributes) != 0) return;
  void* lowest = nullptr;
  std::size_t size = 0;
  ::pthread_attr_getstack(&attributes, &lowest, &size);
  ::pthread_attr_destroy(&attributes);
  lowest_of_stack = static_cast<const char*>(lowest);
}

CrashStack::~CrashStack() {
  stack_t none{};
  none.ss_flags = SS_DISABLE;
  ::sigaltstack(&none, nullptr);
  lowest_of_stack = nullptr;
}

int thread_number() { return static_cast<int>(::syscall(SYS_gettid)); }

}  // namespace armature::platform
