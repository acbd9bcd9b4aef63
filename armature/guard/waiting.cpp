// SPDX-License-Identifier: Apache-2.0
// Locks and sleep. That a lock happens to be free does not excuse taking it: the next time it may
// not be. Trying to take it is allowed, and so are unlocking and telling others.
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <ctime>

#include <linux/futex.h>
#include <poll.h>
#include <pthread.h>
#include <sched.h>
#include <semaphore.h>
#include <sys/epoll.h>
#include <sys/select.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "armature/guard/internal/watch.hpp"

namespace armature::guard {

ARMATURE_GUARD(int, pthread_mutex_lock, (pthread_mutex_t * mutex), (mutex))
ARMATURE_GUARD(int, pthread_mutex_timedlock, (pthread_mutex_t * mutex, const timespec* until),
               (mutex, until))
ARMATURE_GUARD(int, pthread_mutex_clocklock,
               (pthread_mutex_t * mutex, clockid_t clock, const timespec* until),
               (mutex, clock, until))
ARMATURE_GUARD(int, pthread_rwlock_rdlock, (pthread_rwlock_t * lock), (lock))
ARMATURE_GUARD(int, pthread_rwlock_wrlock, (pthread_rwlock_t * lock), (lock))
ARMATURE_GUARD(int, pthread_rwlock_timedrdlock, (pthread_rwlock_t * lock, const timespec* until),
               (lock, until))
ARMATURE_GUARD(int, pthread_rwlock_timedwrlock, (pthread_rwlock_t * lock, const timespec* until),
               (lock, until))
ARMATURE_GUARD(int, pthread_rwlock_clockrdlock,
               (pthread_rwlock_t * lock, clockid_t clock, const timespec* until),
               (lock, clock, until))
ARMATURE_GUARD(int, pthread_rwlock_clockwrlock,
               (pthread_rwlock_t * lock, clockid_t clock, const timespec* until),
               (lock, clock, until))
ARMATURE_GUARD(int, pthread_spin_lock, (pthread_spinlock_t * lock), (lock))
ARMATURE_GUARD(int, pthread_cond_wait, (pthread_cond_t * condition, pthread_mutex_t* mutex),
               (condition, mutex))
ARMATURE_GUARD(int, pthread_cond_timedwait,
               (pthread_cond_t * condition, pthread_mutex_t* mutex, const timespec* until),
               (condition, mutex, until))
ARMATURE_GUARD(int, pthread_cond_clockwait,
               (pthread_cond_t * condition, pthread_mutex_t* mutex, clockid_t clock,
                const timespec* until),
               (condition, mutex, clock, until))
ARMATURE_GUARD(int, pthread_barrier_wait, (pthread_barrier_t * barrier), (barrier))
ARMATURE_GUARD(int, pthread_join, (pthread_t thread, void** result), (thread, result))
ARMATURE_GUARD(int, pthread_create,
               (pthread_t * thread, const pthread_attr_t* attributes, void* (*body)(void*),
                void* argument),
               (thread, attributes, body, argument))
ARMATURE_GUARD(int, sem_wait, (sem_t * semaphore), (semaphore))
ARMATURE_GUARD(int, sem_timedwait, (sem_t * semaphore, const timespec* until), (semaphore, until))
ARMATURE_GUARD(int, sem_clockwait, (sem_t * semaphore, clockid_t clock, const timespec* until),
               (semaphore, clock, until))
ARMATURE_GUARD(int, sched_yield, (), ())
ARMATURE_GUARD(int, pause, (), ())
ARMATURE_GUARD(int, sigsuspend, (const sigset_t* mask), (mask))
ARMATURE_GUARD(int, sigwait, (const sigset_t* set, int* signal), (set, signal))
ARMATURE_GUARD(int, sigwaitinfo, (const sigset_t* set, siginfo_t* info), (set, info))
ARMATURE_GUARD(int, sigtimedwait, (const sigset_t* set, siginfo_t* info, const timespec* limit),
               (set, info, limit))

ARMATURE_GUARD_SLEEP(int, nanosleep, (const timespec* time, timespec* rest), (time, rest))
ARMATURE_GUARD_SLEEP(int, clock_nanosleep,
                     (clockid_t clock, int flags, const timespec* time, timespec* rest),
                     (clock, flags, time, rest))
ARMATURE_GUARD_SLEEP(int, usleep, (useconds_t time), (time))
ARMATURE_GUARD_SLEEP(unsigned, sleep, (unsigned seconds), (seconds))
ARMATURE_GUARD_SLEEP(int, poll, (pollfd * files, nfds_t count, int limit), (files, count, limit))
ARMATURE_GUARD_SLEEP(int, ppoll,
                     (pollfd * files, nfds_t count, const timespec* limit, const sigset_t* mask),
                     (files, count, limit, mask))
ARMATURE_GUARD_SLEEP(int, select,
                     (int count, fd_set* read, fd_set* write, fd_set* other, timeval* limit),
                     (count, read, write, other, limit))
ARMATURE_GUARD_SLEEP(int, pselect,
                     (int count, fd_set* read, fd_set* write, fd_set* other, const timespec* limit,
                      const sigset_t* mask),
                     (count, read, write, other, limit, mask))
ARMATURE_GUARD_SLEEP(int, epoll_wait, (int epoll, epoll_event* events, int size, int limit),
                     (epoll, events, size, limit))
ARMATURE_GUARD_SLEEP(int, epoll_pwait,
                     (int epoll, epoll_event* events, int size, int limit, const sigset_t* mask),
                     (epoll, events, size, limit, mask))

ARMATURE_GUARD(pid_t, waitpid, (pid_t process, int* status, int options),
               (process, status, options))
ARMATURE_GUARD(pid_t, fork, (), ())
ARMATURE_GUARD(int, system, (const char* command), (command), path(command))
ARMATURE_GUARD(FILE*, popen, (const char* command, const char* mode), (command, mode),
               path(command))

/// The process may end without the last word of libraries.
ARMATURE_GUARD_FUNCTION([[noreturn]] void, _exit, (int status)) {
  static constinit std::atomic<void (*)(int)> behind{nullptr};
  print_end();
  next(behind, "_exit")(status);
  __builtin_unreachable();
}

namespace {

/// Waking others does not wait, nor do questions about oneself.
bool is_harmless(long number, long operation) {
  switch (number) {
    case SYS_futex:
      switch (operation & FUTEX_CMD_MASK) {
        case FUTEX_WAKE:
        case FUTEX_WAKE_OP:
        case FUTEX_WAKE_BITSET:
        case FUTEX_REQUEUE:
        case FUTEX_CMP_REQUEUE:
          return true;
        default:
          return false;
      }
    case SYS_gettid:
    case SYS_getpid:
    case SYS_getcpu:
    case SYS_clock_gettime:
      return true;
    default:
      return false;
  }
}

}  // namespace

ARMATURE_GUARD_FUNCTION(long, syscall, (long number, ...)) {
  static constinit std::atomic<long (*)(long, ...)> behind{nullptr};
  va_list rest;
  va_start(rest, number);
  long arguments[6];
  for (long& argument : arguments) argument = va_arg(rest, long);
  va_end(rest);
  if (!is_harmless(number, arguments[1]))
    ARMATURE_GUARD_NOTE(syscall,
                        armature::guard::number("number ", static_cast<std::size_t>(number)));
  return next(behind, "syscall")(number, arguments[0], arguments[1], arguments[2], arguments[3],
                                 arguments[4], arguments[5]);
}

}  // namespace armature::guard
