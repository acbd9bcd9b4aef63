// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/sockets/poller.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <ctime>
#include <string>
#include <system_error>

#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include "armature/platform/internal/descriptor.hpp"
#include "armature/platform/internal/direct_calls.hpp"

namespace armature::platform {
namespace {

using internal::Descriptor;

constexpr std::uint64_t kAlarm = ~std::uint64_t{0};
constexpr std::uint64_t kTimer = kAlarm - 1;

epoll_event event_of(std::uint64_t key, Interest interest) {
  epoll_event event{};
  const bool news = interest.news && !interest.write;
  event.events = (interest.read ? EPOLLIN | EPOLLRDHUP : 0u) | (interest.write ? EPOLLOUT : 0u) |
                 (news ? EPOLLET : 0u);
  event.data.u64 = key;
  return event;
}

timespec timespec_of(std::int64_t ns) {
  timespec time{};
  time.tv_sec = static_cast<time_t>(ns / 1'000'000'000);
  time.tv_nsec = static_cast<long>(ns % 1'000'000'000);
  return time;
}

bool watch(int events, int handle, std::uint64_t key) {
  epoll_event event = event_of(key, {.read = true});
  return handle >= 0 && ::epoll_ctl(events, EPOLL_CTL_ADD, handle, &event) == 0;
}

/// Makes it silent again.
void silence(int handle) {
  std::uint64_t ignored = 0;
  [[maybe_unused]] const ssize_t size = ::read(handle, &ignored, sizeof ignored);
}

/// A kernel before 5.11 counts in milliseconds.
int wait_for(int events, epoll_event* happened, int most, base::Duration limit) {
  if (limit == base::Duration::max()) return internal::direct_epoll_wait(events, happened, most);
  const base::Duration left = std::max(limit, base::Duration::zero());
  const timespec timeout = timespec_of(left.count());
  const int count = ::epoll_pwait2(events, happened, most, &timeout, nullptr);
  if (count >= 0 || errno != ENOSYS) return count;
  const auto ms = std::chrono::ceil<std::chrono::milliseconds>(left).count();
  return ::epoll_wait(events, happened, most,
                      static_cast<int>(std::min<std::int64_t>(ms, 3'600'000)));
}

}  // namespace

base::Result<std::unique_ptr<Poller>> Poller::make() {
  Descriptor events(::epoll_create1(EPOLL_CLOEXEC));
  Descriptor alarm(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK));
  Descriptor timer(::timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC | TFD_NONBLOCK));
  if (events.get() < 0 || !watch(events.get(), alarm.get(), kAlarm) ||
      !watch(events.get(), timer.get(), kTimer)) {
    return base::Error{"no descriptor to wait with: " + std::generic_category().message(errno) +
                       " (ulimit -n shows how many a process may have)"};
  }
  return std::unique_ptr<Poller>(new Poller(events.release(), alarm.release(), timer.release()));
}

Poller::~Poller() {
  ::close(events_);
  ::close(alarm_);
  ::close(timer_);
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
  time_has_come_ = false;
  for (int i = 0; i < count; ++i) {
    const epoll_event& event = happened[i];
    if (event.data.u64 == kAlarm) {
      silence(alarm_);
      // Only now: whoever wakes from here on finds the alarm silent and has it ring.
      woken_.store(false, std::memory_order_seq_cst);
      continue;
    }
    if (event.data.u64 == kTimer) {
      silence(timer_);
      rings_at_ = base::Time::max();
      time_has_come_ = true;
      continue;
    }
    const bool broken = (event.events & (EPOLLERR | EPOLLHUP)) != 0;
    const bool ended = broken || (event.events & EPOLLRDHUP) != 0;
    ready_[found++] = {event.data.u64, ended || (event.events & EPOLLIN) != 0,
                       broken || (event.events & EPOLLOUT) != 0, ended};
  }
  return {ready_.data(), found};
}

void Poller::wake() {
  if (woken_.exchange(true, std::memory_order_seq_cst)) return;
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = ::write(alarm_, &one, sizeof one);
}

void Poller::wake_at(base::Time time) {
  if (time >= rings_at_) return;
  // A time of 0 would disarm it.
  const std::int64_t ns = std::max<std::int64_t>(base::to_ns(time), 1);
  const itimerspec when{.it_interval = {}, .it_value = timespec_of(ns)};
  if (::timerfd_settime(timer_, TFD_TIMER_ABSTIME, &when, nullptr) == 0) rings_at_ = time;
}

}  // namespace armature::platform
