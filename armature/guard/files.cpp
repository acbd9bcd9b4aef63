// SPDX-License-Identifier: Apache-2.0
// Files, devices and sockets. A driver whose device never waits takes a PermitScope.
#include <cstdarg>

#include <dirent.h>
#include <fcntl.h>
#include <netdb.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include "armature/guard/internal/watch.hpp"

namespace armature::guard {

ARMATURE_GUARD(ssize_t, read, (int fd, void* to, std::size_t size), (fd, to, size), file(fd, size))
ARMATURE_GUARD(ssize_t, __read_chk, (int fd, void* to, std::size_t size, std::size_t room),
               (fd, to, size, room), file(fd, size))
ARMATURE_GUARD(ssize_t, readv, (int fd, const iovec* to, int count), (fd, to, count), file(fd))
ARMATURE_GUARD(ssize_t, pread, (int fd, void* to, std::size_t size, off_t at), (fd, to, size, at),
               file(fd, size))
ARMATURE_GUARD(ssize_t, pread64, (int fd, void* to, std::size_t size, off64_t at),
               (fd, to, size, at), file(fd, size))
ARMATURE_GUARD(ssize_t, write, (int fd, const void* from, std::size_t size), (fd, from, size),
               file(fd, size))
ARMATURE_GUARD(ssize_t, writev, (int fd, const iovec* from, int count), (fd, from, count), file(fd))
ARMATURE_GUARD(ssize_t, pwrite, (int fd, const void* from, std::size_t size, off_t at),
               (fd, from, size, at), file(fd, size))
ARMATURE_GUARD(ssize_t, pwrite64, (int fd, const void* from, std::size_t size, off64_t at),
               (fd, from, size, at), file(fd, size))
ARMATURE_GUARD(int, close, (int fd), (fd), file(fd))
ARMATURE_GUARD(int, fsync, (int fd), (fd), file(fd))
ARMATURE_GUARD(int, fdatasync, (int fd), (fd), file(fd))
ARMATURE_GUARD(int, ftruncate, (int fd, off_t size), (fd, size), file(fd))
ARMATURE_GUARD(off_t, lseek, (int fd, off_t by, int from), (fd, by, from), file(fd))
ARMATURE_GUARD(int, creat, (const char* name, mode_t mode), (name, mode), path(name))
ARMATURE_GUARD(int, unlink, (const char* name), (name), path(name))
ARMATURE_GUARD(int, rename, (const char* from, const char* to), (from, to), path(from))
ARMATURE_GUARD(int, mkdir, (const char* name, mode_t mode), (name, mode), path(name))
ARMATURE_GUARD(int, access, (const char* name, int mode), (name, mode), path(name))
ARMATURE_GUARD(int, stat, (const char* name, struct stat* to), (name, to), path(name))
ARMATURE_GUARD(DIR*, opendir, (const char* name), (name), path(name))

ARMATURE_GUARD(int, socket, (int domain, int type, int protocol), (domain, type, protocol))
ARMATURE_GUARD(int, connect, (int fd, const sockaddr* to, socklen_t size), (fd, to, size), file(fd))
ARMATURE_GUARD(int, bind, (int fd, const sockaddr* to, socklen_t size), (fd, to, size), file(fd))
ARMATURE_GUARD(int, accept, (int fd, sockaddr* from, socklen_t* size), (fd, from, size), file(fd))
ARMATURE_GUARD(int, accept4, (int fd, sockaddr* from, socklen_t* size, int flags),
               (fd, from, size, flags), file(fd))
ARMATURE_GUARD(ssize_t, send, (int fd, const void* from, std::size_t size, int flags),
               (fd, from, size, flags), file(fd, size))
ARMATURE_GUARD(ssize_t, sendto,
               (int fd, const void* from, std::size_t size, int flags, const sockaddr* to,
                socklen_t length),
               (fd, from, size, flags, to, length), file(fd, size))
ARMATURE_GUARD(ssize_t, sendmsg, (int fd, const msghdr* message, int flags), (fd, message, flags),
               file(fd))
ARMATURE_GUARD(int, sendmmsg, (int fd, mmsghdr* messages, unsigned count, int flags),
               (fd, messages, count, flags), file(fd))
ARMATURE_GUARD(ssize_t, recv, (int fd, void* to, std::size_t size, int flags),
               (fd, to, size, flags), file(fd, size))
ARMATURE_GUARD(ssize_t, recvfrom,
               (int fd, void* to, std::size_t size, int flags, sockaddr* from, socklen_t* length),
               (fd, to, size, flags, from, length), file(fd, size))
ARMATURE_GUARD(ssize_t, recvmsg, (int fd, msghdr* message, int flags), (fd, message, flags),
               file(fd))
ARMATURE_GUARD(int, recvmmsg,
               (int fd, mmsghdr* messages, unsigned count, int flags, timespec* limit),
               (fd, messages, count, flags, limit), file(fd))
ARMATURE_GUARD(int, shutdown, (int fd, int how), (fd, how), file(fd))
ARMATURE_GUARD(int, getaddrinfo,
               (const char* host, const char* service, const addrinfo* hints, addrinfo** found),
               (host, service, hints, found))

/// A function whose last argument is there or not, and is an integer or a pointer.
#define ARMATURE_GUARD_OPTIONAL(name, parameters, arguments, last, detail) \
  ARMATURE_GUARD_FUNCTION(int, name, parameters) {                         \
    static constinit std::atomic<int(*) parameters> behind{nullptr};       \
    ARMATURE_GUARD_NOTE(name, detail);                                     \
    va_list rest;                                                          \
    va_start(rest, last);                                                  \
    void* const optional = va_arg(rest, void*);                            \
    va_end(rest);                                                          \
    return next(behind, #name) arguments;                                  \
  }

ARMATURE_GUARD_OPTIONAL(open, (const char* name, int flags, ...), (name, flags, optional), flags,
                        path(name))
ARMATURE_GUARD_OPTIONAL(open64, (const char* name, int flags, ...), (name, flags, optional), flags,
                        path(name))
ARMATURE_GUARD_OPTIONAL(openat, (int fd, const char* name, int flags, ...),
                        (fd, name, flags, optional), flags, path(name))
ARMATURE_GUARD_OPTIONAL(openat64, (int fd, const char* name, int flags, ...),
                        (fd, name, flags, optional), flags, path(name))
ARMATURE_GUARD_OPTIONAL(ioctl, (int fd, unsigned long request, ...), (fd, request, optional),
                        request, file(fd))
ARMATURE_GUARD_OPTIONAL(fcntl, (int fd, int command, ...), (fd, command, optional), command,
                        file(fd))
ARMATURE_GUARD_OPTIONAL(fcntl64, (int fd, int command, ...), (fd, command, optional), command,
                        file(fd))

}  // namespace armature::guard
