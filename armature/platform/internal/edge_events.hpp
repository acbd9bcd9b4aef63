// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cerrno>
#include <cstdint>

#include <sys/epoll.h>
#include <unistd.h>

namespace armature::platform::internal {

inline bool add_event(int events, int fd, std::uint32_t kind) {
  epoll_event event{};
  event.events = kind;
  event.data.fd = fd;
  return ::epoll_ctl(events, EPOLL_CTL_ADD, fd, &event) == 0;
}

/// Waits for what was added to `events`; false if it is the `interruption`.
inline bool wait_for_events(int events, int interruption) {
  epoll_event happened[2];
  int count = 0;
  do {
    count = ::epoll_wait(events, happened, 2, -1);
  } while (count < 0 && errno == EINTR);
  return count > 0 && std::none_of(happened, happened + count, [=](const epoll_event& event) {
           return event.data.fd == interruption;
         });
}

inline void interrupt_events(int interruption) {
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = ::write(interruption, &one, sizeof one);
}

}  // namespace armature::platform::internal
