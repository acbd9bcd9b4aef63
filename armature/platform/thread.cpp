// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/thread.hpp"

#include <algorithm>
#include <cerrno>
#include <condition_variable>
#include <csignal>
#include <cstdint>
#include <ctime>
#include <mutex>
#include <system_error>
#include <utility>

#include <alloca.h>
#include <pthread.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "armature/platform/death_watch.hpp"

namespace armature::platform {
namespace {

/// The kernel's structure; its own header cannot be included beside <sched.h>.
struct DeadlineAttributes {
  std::uint32_t size;
  std::uint32_t policy;
  std::uint64_t flags;
  std::int32_t nice;
  std::uint32_t priority;
  std::uint64_t runtime;
  std::uint64_t deadline;
  std::uint64_t period;
};

std::string why(int error) { return std::generic_category().message(error); }

/// The system ignores CPUs that the machine does not have, so look at what came of it.
void apply_cpus(const ThreadRequest& request, ThreadGrant& grant) {
  if (request.cpus.empty()) return;
  const auto bit = [](int cpu) { return static_cast<std::size_t>(cpu); };
  cpu_set_t set;
  CPU_ZERO(&set);
  for (const int cpu : request.cpus) {
    if (cpu >= 0 && cpu < CPU_SETSIZE) CPU_SET(bit(cpu), &set);
  }
  const int error = pthread_setaffinity_np(pthread_self(), sizeof set, &set);
  CPU_ZERO(&set);
  if (error == 0) pthread_getaffinity_np(pthread_self(), sizeof set, &set);
  for (const int cpu : request.cpus) {
    if (cpu >= 0 && cpu < CPU_SETSIZE && CPU_ISSET(bit(cpu), &set)) {
      grant.cpus.push_back(cpu);
    } else {
      grant.refusals.push_back("CPU " + std::to_string(cpu) + ": " +
                               why(error != 0 ? error : EINVAL) + "; this machine has CPUs 0.." +
                               std::to_string(sysconf(_SC_NPROCESSORS_ONLN) - 1));
    }
  }
}

void apply_fifo(const ThreadRequest& request, ThreadGrant& grant) {
  sched_param parameters{};
  parameters.sched_priority = request.priority;
  const int error = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
  if (error == 0) {
    grant.scheduler = Scheduler::kFifo;
    grant.priority = request.priority;
    return;
  }
  const char* const hint = error == EINVAL
                               ? "; priorities are 1..99"
                               : "; run as root, or allow rtprio in /etc/security/limits.conf, or "
                                 "give the program CAP_SYS_NICE";
  grant.refusals.push_back("SCHED_FIFO priority " + std::to_string(request.priority) + ": " +
                           why(error) + hint);
}

void apply_deadline(const ThreadRequest& request, ThreadGrant& grant) {
  // glibc 2.36 has no wrapper for this system call.
  DeadlineAttributes attributes{};
  attributes.size = sizeof attributes;
  attributes.policy = SCHED_DEADLINE;
  attributes.runtime = static_cast<std::uint64_t>(request.runtime.count());
  attributes.deadline = static_cast<std::uint64_t>(request.period.count());
  attributes.period = static_cast<std::uint64_t>(request.period.count());
  if (syscall(SYS_sched_setattr, 0, &attributes, 0) == 0) {
    grant.scheduler = Scheduler::kDeadline;
    return;
  }
  grant.refusals.push_back("SCHED_DEADLINE: " + why(errno) +
                           "; it needs root, a runtime below the period, free bandwidth, and no "
                           "CPU affinity narrower than the machine");
}

void apply_scheduler(const ThreadRequest& request, ThreadGrant& grant) {
  if (request.scheduler == Scheduler::kFifo) apply_fifo(request, grant);
  if (request.scheduler == Scheduler::kDeadline) apply_deadline(request, grant);
}

}  // namespace

namespace {

/// Less than what was asked for: thread-local variables lie on the stack too.
std::size_t bytes_left_on_stack() {
  pthread_attr_t attributes;
  if (pthread_getattr_np(pthread_self(), &attributes) != 0) return 0;
  void* lowest = nullptr;
  std::size_t size = 0;
  pthread_attr_getstack(&attributes, &lowest, &size);
  pthread_attr_destroy(&attributes);
  // Not where a variable is: a sanitizer may keep them elsewhere.
  const auto* const here = static_cast<const char*>(__builtin_frame_address(0));
  return static_cast<std::size_t>(here - static_cast<const char*>(lowest));
}

void prefault_rest_of_stack() {
  constexpr std::size_t kHeadroom = 64 * 1024;
  const std::size_t left = bytes_left_on_stack();
  if (left > 2 * kHeadroom) prefault_stack(left - kHeadroom);
}

/// Those that ask for a stop are for the thread that stops, whoever of the others is not busy.
void leave_stop_signals_to_others() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals, signal);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

}  // namespace

bool run_when_idle() {
  const sched_param none{};
  return pthread_setschedparam(pthread_self(), SCHED_IDLE, &none) == 0;
}

void prefault_stack(std::size_t bytes) {
  auto* stack = static_cast<volatile char*>(alloca(bytes));
  constexpr std::size_t kPage = 4096;
  for (std::size_t i = 0; i < bytes; i += kPage) stack[i] = 0;
}

struct Thread::State {
  ThreadRequest request;
  std::function<void()> body;
  ThreadGrant grant;
  pthread_t handle{};
  bool joinable = false;
  std::mutex mutex;
  std::condition_variable changed;
  bool granted = false;
  bool ended = false;

  static void* enter(void* argument) {
    const std::unique_ptr<std::shared_ptr<State>> self(
        static_cast<std::shared_ptr<State>*>(argument));
    (*self)->run();
    return nullptr;
  }

  void run() {
    const CrashStack crash_stack;
    leave_stop_signals_to_others();
    pthread_setname_np(pthread_self(), request.name.substr(0, 15).c_str());
    // The kernel may otherwise delay every wake-up by 50 us to save power; 1 ns is its least.
    prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
    apply_cpus(request, grant);
    apply_scheduler(request, grant);
    if (request.prefault) prefault_rest_of_stack();
    announce(granted);
    body();
    announce(ended);
  }

  void announce(bool& event) {
    {
      const std::lock_guard lock(mutex);
      event = true;
    }
    changed.notify_all();
  }
};

Thread::Thread(const ThreadRequest& request, std::function<void()> body)
    : state_(std::make_shared<State>()) {
  state_->request = request;
  state_->body = std::move(body);
  // The thread holds its own reference: an abandoned one may outlive this object.
  auto argument = std::make_unique<std::shared_ptr<State>>(state_);

  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  constexpr std::size_t kLeastStack = 64 * 1024;
  pthread_attr_setstacksize(&attributes,
                            std::max(request.stack_bytes, kLeastStack) + sizeof(CrashStack));
  const int error = pthread_create(&state_->handle, &attributes, State::enter, argument.get());
  pthread_attr_destroy(&attributes);
  if (error != 0) {
    throw std::system_error(error, std::generic_category(),
                            "cannot start the thread '" + request.name + "'");
  }
  static_cast<void>(argument.release());
  state_->joinable = true;
  std::unique_lock lock(state_->mutex);
  state_->changed.wait(lock, [this] { return state_->granted; });
}

Thread::~Thread() { join(); }

const ThreadGrant& Thread::grant() const { return state_->grant; }

void Thread::join() {
  if (!state_->joinable) return;
  pthread_join(state_->handle, nullptr);
  state_->joinable = false;
}

bool Thread::join_within(base::Duration limit) {
  if (!state_->joinable) return true;
  limit = std::min<base::Duration>(limit, std::chrono::hours(24 * 365));  // waits add it to a clock
  // Not pthread_clockjoin_np: ThreadSanitizer does not know it and loses count of the threads.
  {
    std::unique_lock lock(state_->mutex);
    if (!state_->changed.wait_for(lock, limit, [this] { return state_->ended; })) return false;
  }
  join();
  return true;
}

void Thread::abandon() {
  if (!state_->joinable) return;
  pthread_detach(state_->handle);
  state_->joinable = false;
}

}  // namespace armature::platform
