// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/poller.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <ctime>
#include <string>
#include <system_error>

#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include "armature/platform/internal/descriptor.hpp"

namespace armature::platform {
namespace {

using internal::Descriptor;

constexpr std::uint64_t kAlarm = ~std::uint64_t{0};

epoll_event event_of(std::uint64_t key, Interest interest) {
  epoll_event event{};
  event.events = (interest.read ? EPOLLIN | EPOLLRDHUP : 0u) | (interest.write ? EPOLLOUT : 0u);
  event.data.u64 = key;
  return event;
}

/// A kernel before 5.11 counts in milliseconds.
int wait_for(int events, epoll_event* happened, int most, base::Duration limit) {
  if (limit == base::Duration::max()) return ::epoll_wait(events, happened, most, -1);
  const base::Duration left = std::max(limit, base::Duration::zero());
  timespec timeout{};
  timeout.tv_sec = static_cast<time_t>(left.count() / 1'000'000'000);
  timeout.tv_nsec = static_cast<long>(left.count() % 1'000'000'000);
  const int count = ::epoll_pwait2(events, happened, most, &timeout, nullptr);
  if (count >= 0 || errno != ENOSYS) return count;
  const auto ms = std::chrono::ceil<std::chrono::milliseconds>(left).count();
  return ::epoll_wait(events, happened, most, static_cast<int>(std::min<long>(ms, 3'600'000)));
}

}  // namespace

base::Result<std::unique_ptr<Poller>> Poller::make() {
  Descriptor events(::epoll_create1(EPOLL_CLOEXEC));
  Descriptor alarm(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK));
  epoll_event event = event_of(kAlarm, {.read = true});
  if (events.get() < 0 || alarm.get() < 0 ||
      ::epoll_ctl(events.get(), EPOLL_CTL_ADD, alarm.get(), &event) != 0) {
    return base::Error{"no descriptor to wait with: " + std::generic_category().message(errno) +
                       " (ulimit -n shows how many a process may have)"};
  }
  return std::unique_ptr<Poller>(new Poller(events.release(), alarm.release()));
}

Poller::~Poller() {
  ::close(events_);
  ::close(alarm_);
}

bool Poller::add(int handle, std::uint64_t key, Interest interest) {
  epoll_event event = event_of(key, interest);
  return ::epoll_ctl(events_, EPOLL_CTL_ADD, handle, &event) == 0;
}

bool Poller::change(int handle, std::uint64_t key, Interest interest) {
  epoll_event event = event_of(key, interest);
  return ::epoll_ctl(events_, EPOLL_CTL_MOD, handle, &event) == 0;
}

void Poller::remove(int handle) { ::epoll_ctl(events_, EPOLL_CTL_DEL, handle, nullptr); }

std::span<const Ready> Poller::wait(base::Duration limit) {
  epoll_event happened[kMost];
  const int count = wait_for(events_, happened, static_cast<int>(kMost), limit);
  std::size_t found = 0;
  for (int i = 0; i < count; ++i) {
    const epoll_event& event = happened[i];
    if (event.data.u64 == kAlarm) {
      std::uint64_t ignored = 0;
      [[maybe_unused]] const ssize_t size = ::read(alarm_, &ignored, sizeof ignored);
      // Only now: whoever wakes from here on finds the alarm silent and has it ring.
      woken_.store(false, std::memory_order_seq_cst);
      continue;
    }
    const bool ended = (event.events & (EPOLLERR | EPOLLHUP)) != 0;
    ready_[found++] = {event.data.u64, ended || (event.events & (EPOLLIN | EPOLLRDHUP)) != 0,
                       ended || (event.events & EPOLLOUT) != 0};
  }
  return {ready_.data(), found};
}

void Poller::wake() {
  if (woken_.exchange(true, std::memory_order_seq_cst)) return;
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = ::write(alarm_, &one, sizeof one);
}

}  // namespace armature::platform
