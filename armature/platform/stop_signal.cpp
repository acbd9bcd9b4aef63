// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/stop_signal.hpp"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <iterator>

#include <poll.h>
#include <signal.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include "armature/platform/clock.hpp"

namespace armature::platform {
namespace {

/// Asks for a stop: Ctrl-C, `kill`, a terminal that has gone.
constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};

std::atomic<bool> signal_received{false};
std::atomic<int> insistent_signals{0};
std::atomic<bool> hung_up{false};
std::atomic<int> woken_descriptor{-1};
struct sigaction handlers_before[std::size(kSignals)];

/// A terminal that goes away says so twice, by its shell and by itself: that is no second wish.
void on_signal(int signal) {
  if (signal == SIGHUP && hung_up.exchange(true)) return;
  if (signal != SIGHUP && insistent_signals.fetch_add(1) > 0) _exit(130);
  signal_received = true;
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = ::write(woken_descriptor, &one, sizeof one);
}

}  // namespace

StopSignal::StopSignal() {
  signal_received = hung_up = false;
  insistent_signals = 0;
  woken_descriptor = ::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  struct sigaction action {};
  action.sa_handler = on_signal;
  sigemptyset(&action.sa_mask);
  for (std::size_t i = 0; i < std::size(kSignals); ++i) {
    sigaction(kSignals[i], &action, &handlers_before[i]);
    const bool by_nohup = kSignals[i] == SIGHUP && handlers_before[i].sa_handler == SIG_IGN;
    if (by_nohup) sigaction(SIGHUP, &handlers_before[i], nullptr);
  }
}

StopSignal::~StopSignal() {
  for (std::size_t i = 0; i < std::size(kSignals); ++i) {
    sigaction(kSignals[i], &handlers_before[i], nullptr);
  }
  ::close(woken_descriptor);
  woken_descriptor = -1;
}

int StopSignal::descriptor() const { return woken_descriptor; }

bool StopSignal::received() const { return signal_received; }

void StopSignal::hear_next() const {
  signal_received = false;
  hung_up = true;  // what follows is an operator's answer; a terminal that goes away gives none
  insistent_signals = 0;
  std::uint64_t count = 0;
  [[maybe_unused]] const ssize_t read = ::read(woken_descriptor, &count, sizeof count);
}

bool StopSignal::wait_until(base::Time deadline) const {
  while (!received()) {
    const base::Duration left = deadline - monotonic_now();
    if (left <= base::Duration::zero()) return false;
    const auto ms = std::chrono::ceil<std::chrono::milliseconds>(left).count();
    pollfd descriptor{.fd = woken_descriptor, .events = POLLIN, .revents = 0};
    ::poll(&descriptor, 1, static_cast<int>(std::min<std::int64_t>(ms, 1000)));
  }
  return true;
}

}  // namespace armature::platform
