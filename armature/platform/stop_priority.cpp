// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/stop_priority.hpp"

#include <algorithm>
#include <csignal>
#include <cstdint>

#include <poll.h>
#include <sched.h>
#include <sys/eventfd.h>
#include <sys/resource.h>
#include <unistd.h>

#include "armature/platform/clock.hpp"
#include "armature/platform/death_watch.hpp"

namespace armature::platform {
namespace {

/// Above all threads of components (1..97 are usual), below guardians.
constexpr int kPriority = 98;
constexpr int kBestNice = -20;

sigset_t stop_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals, signal);
  return signals;
}

/// @return whether the thread took them
bool take_no_stop_signals() {
  const sigset_t signals = stop_signals();
  sigset_t before;
  pthread_sigmask(SIG_BLOCK, &signals, &before);
  return sigismember(&before, SIGTERM) == 0;
}

void take_stop_signals() {
  const sigset_t signals = stop_signals();
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
}

}  // namespace

void make_prompt(int number) {
  if (number == 0) return;
  for (int nice = kBestNice; nice < 0; ++nice) {
    if (::setpriority(PRIO_PROCESS, static_cast<id_t>(number), nice) == 0) return;
  }
}

Promptness::Promptness() : before_(::getpriority(PRIO_PROCESS, 0)) { make_prompt(thread_number()); }

Promptness::~Promptness() { ::setpriority(PRIO_PROCESS, 0, before_); }

void make_most_urgent(int number) {
  sched_param parameters{};
  parameters.sched_priority = kPriority;
  if (::sched_setscheduler(number, SCHED_FIFO, &parameters) == 0) return;
  make_prompt(number == 0 ? thread_number() : number);
}

StopPriority::StopPriority(const StopSignal& stop, base::Time end)
    : takes_over_(take_no_stop_signals()),
      stopper_(thread_number()),
      interruption_(::eventfd(0, EFD_CLOEXEC)) {
  ThreadRequest request;
  request.name = "stop";
  request.stack_bytes = 64 * 1024;
  request.prefault = false;
  thread_ = std::make_unique<Thread>(request, [this, &stop, end] { watch(stop, end); });
}

StopPriority::~StopPriority() {
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = ::write(interruption_, &one, sizeof one);
  thread_->join();
  ::close(interruption_);
  if (takes_over_) take_stop_signals();
}

void StopPriority::watch(const StopSignal& stop, base::Time end) const {
  make_most_urgent(thread_number());
  ::poll(nullptr, 0, 0);  // GCC 12's thread sanitizer loses signals during a thread's first wait
  take_stop_signals();
  pollfd events[] = {{.fd = stop.descriptor(), .events = POLLIN, .revents = 0},
                     {.fd = interruption_, .events = POLLIN, .revents = 0}};
  while (events[0].revents == 0 && events[1].revents == 0) {
    const base::Duration left = end - monotonic_now();
    if (left <= base::Duration::zero()) break;
    const auto ms = std::chrono::ceil<std::chrono::milliseconds>(left).count();
    ::poll(events, 2, static_cast<int>(std::min<std::int64_t>(ms, 3'600'000)));
  }
  if (events[1].revents != 0) return;
  make_most_urgent(stopper_);
  // Who hears the first signal hears the next.
  while (events[1].revents == 0) ::poll(&events[1], 1, -1);
}

}  // namespace armature::platform
