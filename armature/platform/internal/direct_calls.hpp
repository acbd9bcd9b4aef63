// SPDX-License-Identifier: Apache-2.0
#pragma once

// What glibc's functions of these names do, without its points of cancellation: those are two more
// calls of functions, whose returns a processor predicts badly so soon after the kernel, and cost
// more than half a percent of a round trip. Sanitizers know glibc's functions only.

#include <cstddef>

#include <sys/epoll.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
#define ARMATURE_PLATFORM_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(realtime_sanitizer) || __has_feature(thread_sanitizer) || \
    __has_feature(address_sanitizer) || __has_feature(memory_sanitizer)
#define ARMATURE_PLATFORM_SANITIZED 1
#endif
#endif

namespace armature::platform::internal {

#ifdef ARMATURE_PLATFORM_SANITIZED

inline ssize_t direct_send(int socket, const void* bytes, std::size_t size, int flags) {
  return ::send(socket, bytes, size, flags);
}
inline ssize_t direct_recv(int socket, void* room, std::size_t size, int flags) {
  return ::recv(socket, room, size, flags);
}
inline int direct_epoll_wait(int events, epoll_event* happened, int most) {
  return ::epoll_wait(events, happened, most, -1);
}

#else

inline ssize_t direct_send(int socket, const void* bytes, std::size_t size, int flags) {
  return ::syscall(SYS_sendto, socket, bytes, size, flags, nullptr, 0);
}
inline ssize_t direct_recv(int socket, void* room, std::size_t size, int flags) {
  return ::syscall(SYS_recvfrom, socket, room, size, flags, nullptr, nullptr);
}
/// Without a time-out.
inline int direct_epoll_wait(int events, epoll_event* happened, int most) {
  return static_cast<int>(::syscall(SYS_epoll_pwait, events, happened, most, -1, nullptr, 8));
}

#endif

}  // namespace armature::platform::internal
