// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/stop_signal.hpp"

#include <algorithm>
#include <atomic>
#include <cstdint>

#include <poll.h>
#include <signal.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include "armature/platform/clock.hpp"

namespace armature::platform {
namespace {

std::atomic<int> signals_received{0};
int wake_descriptor = -1;
struct sigaction previous_interrupt;
struct sigaction previous_terminate;

void on_signal(int) {
  if (signals_received.fetch_add(1) > 0) _exit(130);
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = ::write(wake_descriptor, &one, sizeof one);
}

}  // namespace

StopSignal::StopSignal() {
  signals_received = 0;
  wake_descriptor = ::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  struct sigaction action {};
  action.sa_handler = on_signal;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, &previous_interrupt);
  sigaction(SIGTERM, &action, &previous_terminate);
}

StopSignal::~StopSignal() {
  sigaction(SIGINT, &previous_interrupt, nullptr);
  sigaction(SIGTERM, &previous_terminate, nullptr);
  ::close(wake_descriptor);
  wake_descriptor = -1;
}

bool StopSignal::received() const { return signals_received > 0; }

bool StopSignal::wait_until(base::Time deadline) const {
  while (!received()) {
    const base::Duration left = deadline - monotonic_now();
    if (left <= base::Duration::zero()) return false;
    const auto ms = std::chrono::ceil<std::chrono::milliseconds>(left).count();
    pollfd descriptor{.fd = wake_descriptor, .events = POLLIN, .revents = 0};
    ::poll(&descriptor, 1, static_cast<int>(std::min<std::int64_t>(ms, 1000)));
  }
  return true;
}

}  // namespace armature::platform
