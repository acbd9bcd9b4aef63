// SPDX-License-Identifier: Apache-2.0
// The guard catches each kind of call, and says who called what from where. Nothing here is real:
// the files are /dev/null, the sleeps take no time, the locks are free.
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <memory>
#include <mutex>
#include <semaphore>
#include <shared_mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <dlfcn.h>
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/futex.h>
#include <malloc.h>
#include <poll.h>
#include <pthread.h>
#include <sched.h>
#include <semaphore.h>
#include <sys/epoll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/select.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "armature/component/component.hpp"
#include "armature/exec/application.hpp"
#include "armature/testing/realtime_guard.hpp"

namespace armature {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// Keeps a result, so that nothing is optimised away and no call is the last of its function.
template <typename T>
void keep(T value) {
  asm volatile("" : : "g"(value) : "memory");
}

const timespec kNoTime{};
int null_file = -1;
int sockets[2] = {-1, -1};
std::unique_ptr<std::ofstream> stream;
void* memory = nullptr;
std::vector<int> numbers;
std::mutex mutex;
std::shared_mutex shared_mutex;
std::timed_mutex timed_mutex;
pthread_spinlock_t spin_lock;
pthread_cond_t condition = PTHREAD_COND_INITIALIZER;
pthread_mutex_t condition_mutex = PTHREAD_MUTEX_INITIALIZER;
sem_t posted_semaphore;
int futex_word = 0;

[[gnu::noinline]] void calls_malloc() { keep(memory = std::malloc(40)); }
[[gnu::noinline]] void calls_calloc() { keep(memory = std::calloc(5, 8)); }
[[gnu::noinline]] void calls_realloc() {
  {
    const rt::PermitScope permit;
    memory = std::malloc(8);
  }
  keep(memory = std::realloc(memory, 40));
}
[[gnu::noinline]] void calls_aligned_alloc() { keep(memory = std::aligned_alloc(64, 128)); }
[[gnu::noinline]] void calls_posix_memalign() { keep(posix_memalign(&memory, 64, 128)); }
[[gnu::noinline]] void calls_memalign() { keep(memory = memalign(64, 128)); }
[[gnu::noinline]] void calls_free() {
  {
    const rt::PermitScope permit;
    memory = std::malloc(40);
  }
  std::free(std::exchange(memory, nullptr));
  keep(memory);
}
[[gnu::noinline]] void grows_a_vector() {
  numbers.push_back(1);
  keep(numbers.data());
}
[[gnu::noinline]] void calls_mmap() {
  void* const page = mmap(nullptr, 4096, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  keep(munmap(page, 4096));
}
[[gnu::noinline]] void locks_a_mutex() {
  const std::lock_guard lock(mutex);
  keep(&lock);
}
[[gnu::noinline]] void locks_a_shared_mutex() {
  const std::shared_lock lock(shared_mutex);
  keep(&lock);
}
[[gnu::noinline]] void locks_a_shared_mutex_alone() {
  const std::unique_lock lock(shared_mutex);
  keep(&lock);
}
[[gnu::noinline]] void locks_for_some_time() {
  if (timed_mutex.try_lock_for(std::chrono::nanoseconds(1))) timed_mutex.unlock();
  keep(0);
}
[[gnu::noinline]] void locks_a_spin_lock() {
  pthread_spin_lock(&spin_lock);
  keep(pthread_spin_unlock(&spin_lock));
}
[[gnu::noinline]] void waits_for_a_condition() {
  pthread_mutex_trylock(&condition_mutex);
  keep(pthread_cond_timedwait(&condition, &condition_mutex, &kNoTime));
  pthread_mutex_unlock(&condition_mutex);
}
[[gnu::noinline]] void waits_for_a_semaphore() {
  sem_post(&posted_semaphore);
  keep(sem_wait(&posted_semaphore));
}
[[gnu::noinline]] void waits_by_a_system_call() {
  keep(syscall(SYS_futex, &futex_word, FUTEX_WAIT, 1, &kNoTime, nullptr, 0));
}
[[gnu::noinline]] void starts_a_thread() {
  std::thread thread([] {});
  thread.join();
  keep(0);
}
[[gnu::noinline]] void sleeps() { keep(nanosleep(&kNoTime, nullptr)); }
[[gnu::noinline]] void sleeps_by_a_clock() {
  keep(clock_nanosleep(CLOCK_MONOTONIC, 0, &kNoTime, nullptr));
}
[[gnu::noinline]] void sleeps_in_microseconds() { keep(usleep(0)); }
[[gnu::noinline]] void sleeps_in_seconds() { keep(sleep(0)); }
[[gnu::noinline]] void yields() { keep(sched_yield()); }
[[gnu::noinline]] void polls() {
  pollfd file{null_file, POLLIN, 0};
  keep(poll(&file, 1, 0));
}
[[gnu::noinline]] void selects() {
  timeval limit{};
  keep(select(0, nullptr, nullptr, nullptr, &limit));
}
[[gnu::noinline]] void waits_for_epoll() {
  epoll_event event{};
  keep(epoll_wait(-1, &event, 1, 0));
}
[[gnu::noinline]] void opens_a_file() {
  const int fd = open("/dev/null", O_RDONLY | O_CLOEXEC);
  keep(close(fd));
}
[[gnu::noinline]] void closes_a_file() { keep(close(-1)); }
[[gnu::noinline]] void reads() {
  char letter = 0;
  keep(read(null_file, &letter, 1));
}
[[gnu::noinline]] void writes() { keep(write(null_file, "text", 4)); }
[[gnu::noinline]] void syncs() { keep(fsync(null_file)); }
[[gnu::noinline]] void controls_a_device() {
  int count = 0;
  keep(ioctl(sockets[0], FIONREAD, &count));
}
[[gnu::noinline]] void sends() { keep(send(sockets[0], "x", 1, MSG_DONTWAIT)); }
[[gnu::noinline]] void receives() {
  char letter = 0;
  keep(recv(sockets[1], &letter, 1, MSG_DONTWAIT));
}
[[gnu::noinline]] void connects() { keep(connect(-1, nullptr, 0)); }
[[gnu::noinline]] void accepts() { keep(accept(-1, nullptr, nullptr)); }
[[gnu::noinline]] void prints() { keep(std::printf("%s", "")); }
[[gnu::noinline]] void prints_to_a_stream() { keep(std::fputs("", stdout)); }
[[gnu::noinline]] void writes_to_a_stream() {
  *stream << "text" << std::flush;
  keep(stream.get());
}
[[gnu::noinline]] void loads_a_library() { keep(dlopen("libarmature_nowhere.so", RTLD_NOW)); }
[[gnu::noinline]] void throws() {
  try {
    throw std::runtime_error("a text that is too long to be kept without memory of its own");
  } catch (const std::exception& error) {
    keep(&error);
  }
}

struct Offence {
  const char* function;  ///< that the call stack names
  void (*commit)();
  const char* call;  ///< as the report has it
};

void PrintTo(const Offence& offence, std::ostream* to) { *to << offence.function; }

#define OFFENCE(function, call) \
  Offence { #function, &function, call }

const std::vector<Offence> memory_offences{
    OFFENCE(calls_malloc, "called malloc(40 bytes)"),
    OFFENCE(calls_free, "called free()"),
    OFFENCE(grows_a_vector, "called malloc(4 bytes)"),
    OFFENCE(calls_calloc, "called calloc(40 bytes)"),
    OFFENCE(calls_realloc, "called realloc(40 bytes)"),
    OFFENCE(calls_aligned_alloc, "called aligned_alloc(128 bytes)"),
    OFFENCE(calls_posix_memalign, "called posix_memalign(128 bytes)"),
    OFFENCE(calls_memalign, "called memalign(128 bytes)"),
};

const std::vector<Offence> other_offences{
    OFFENCE(calls_mmap, "called mmap(4096 bytes)"),
    OFFENCE(locks_a_mutex, "called pthread_mutex_lock()"),
    OFFENCE(locks_a_shared_mutex, "called pthread_rwlock_rdlock()"),
    OFFENCE(locks_a_shared_mutex_alone, "called pthread_rwlock_wrlock()"),
    OFFENCE(locks_for_some_time, "called pthread_mutex_clocklock()"),
    OFFENCE(locks_a_spin_lock, "called pthread_spin_lock()"),
    OFFENCE(waits_for_a_condition, "called pthread_cond_timedwait()"),
    OFFENCE(waits_for_a_semaphore, "called sem_wait()"),
    OFFENCE(waits_by_a_system_call, "called syscall(number "),
    OFFENCE(starts_a_thread, "called pthread_create()"),
    OFFENCE(starts_a_thread, "called pthread_join()"),
    OFFENCE(sleeps, "called nanosleep()"),
    OFFENCE(sleeps_by_a_clock, "called clock_nanosleep()"),
    OFFENCE(sleeps_in_microseconds, "called usleep()"),
    OFFENCE(sleeps_in_seconds, "called sleep()"),
    OFFENCE(yields, "called sched_yield()"),
    OFFENCE(polls, "called poll()"),
    OFFENCE(selects, "called select()"),
    OFFENCE(waits_for_epoll, "called epoll_wait()"),
    OFFENCE(opens_a_file, "called open(/dev/null)"),
    OFFENCE(closes_a_file, "called close(file "),
    OFFENCE(reads, "called read(file "),
    OFFENCE(writes, ", 4 bytes), 1 time"),
    OFFENCE(syncs, "called fsync(file "),
    OFFENCE(controls_a_device, "called ioctl(file "),
    OFFENCE(sends, "called send(file "),
    OFFENCE(receives, "called recv(file "),
    OFFENCE(connects, "called connect("),
    OFFENCE(accepts, "called accept("),
    OFFENCE(prints, "called printf(%s)"),
    OFFENCE(prints_to_a_stream, "called fputs()"),
    OFFENCE(writes_to_a_stream, "called write(file "),
    OFFENCE(loads_a_library, "called malloc("),
    OFFENCE(throws, "threw std::runtime_error, 1 time"),
};

/// Commits its offence once.
class Culprit final : public component::Component {
 public:
  using Component::Component;
  void (*commit)() = nullptr;
  bool permitted = false;

 private:
  void on_update() override {
    if (commit == nullptr) return;
    const auto offence = std::exchange(commit, nullptr);
    if (permitted) {
      const rt::PermitScope permit;
      offence();
    } else {
      offence();
    }
    keep(this);
  }
};

class Catches : public ::testing::TestWithParam<Offence> {
 protected:
  void SetUp() override {
    if (std::string_view(ARMATURE_SANITIZER) == "realtime") {
      GTEST_SKIP() << "RealtimeSanitizer ends the process: see rtsan_test.cpp";
    }
    null_file = open("/dev/null", O_RDWR | O_CLOEXEC);
    ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM, 0, sockets), 0);
    stream = std::make_unique<std::ofstream>("/dev/null");
    pthread_spin_init(&spin_lock, PTHREAD_PROCESS_PRIVATE);
    sem_init(&posted_semaphore, 0, 0);
    numbers = {};
  }
  void TearDown() override {
    stream.reset();
    std::free(std::exchange(memory, nullptr));
    for (const int fd : {null_file, sockets[0], sockets[1]}) close(fd);
  }

  void run(bool simulated, bool permitted = false) {
    exec::Blueprint blueprint;
    const auto periodic = exec::Activity::periodic(std::chrono::milliseconds(1));
    auto& culprit = blueprint.add<Culprit>("culprit", periodic);
    culprit.commit = GetParam().commit;
    culprit.permitted = permitted;
    exec::ApplicationOptions options;
    options.simulated = simulated;
    exec::Application application(std::move(blueprint), std::move(options));
    ASSERT_TRUE(application.start().ok());
    while (application.thread_statistics().front().cycles_run < 3) {
      application.run_for(std::chrono::milliseconds(1));
    }
    application.stop();
  }
  void expect_caught() {
    EXPECT_GE(guard_.violations(), 1u);
    EXPECT_THAT(guard_.report(), HasSubstr("'culprit' in thread 'culprit' "));
    EXPECT_THAT(guard_.report(), HasSubstr(GetParam().call));
    EXPECT_THAT(guard_.report(), HasSubstr(std::string("::") + GetParam().function + "()"));
    EXPECT_THAT(guard_.report(), HasSubstr("Culprit::on_update()"));
  }

  testing::RealtimeGuard guard_;
};

class CatchesAllocation : public Catches {};
class CatchesOtherCalls : public Catches {};

std::string name_of_offence(const ::testing::TestParamInfo<Offence>& each) {
  return std::to_string(each.index) + "_" + each.param.function;
}
INSTANTIATE_TEST_SUITE_P(Offences, CatchesAllocation, ::testing::ValuesIn(memory_offences),
                         name_of_offence);
INSTANTIATE_TEST_SUITE_P(Offences, CatchesOtherCalls, ::testing::ValuesIn(other_offences),
                         name_of_offence);

TEST_P(CatchesAllocation, InRealTime) {
  const bool aligned =
      std::string_view(GetParam().function).find("align") != std::string_view::npos;
  if (std::string_view(ARMATURE_SANITIZER) == "thread" && aligned) {
    GTEST_SKIP() << "ThreadSanitizer does not tell its hooks of aligned allocation";
  }
  run(false);
  if (std::string_view(ARMATURE_SANITIZER).empty()) {
    expect_caught();
  } else {
    EXPECT_GE(guard_.violations(), 1u);
  }
}

TEST_P(CatchesAllocation, NotWherePermitted) {
  run(false, true);
  EXPECT_EQ(guard_.violations(), 0u) << guard_.report();
}

TEST_P(CatchesOtherCalls, InRealTime) {
  if (!std::string_view(ARMATURE_SANITIZER).empty()) GTEST_SKIP() << "only allocation is seen";
  run(false);
  expect_caught();
}

TEST_P(CatchesOtherCalls, InSimulatedTime) {
  if (!std::string_view(ARMATURE_SANITIZER).empty()) GTEST_SKIP() << "only allocation is seen";
  run(true);
  expect_caught();
}

TEST_P(CatchesOtherCalls, NotWherePermitted) {
  if (std::string_view(ARMATURE_SANITIZER) == "thread") {
    GTEST_SKIP() << "ThreadSanitizer takes a mutex that was locked within a time for unlocked";
  }
  run(false, true);
  EXPECT_EQ(guard_.violations(), 0u) << guard_.report();
}

void tries_without_waiting() {
  if (mutex.try_lock()) mutex.unlock();
  std::free(nullptr);
  syscall(SYS_futex, &futex_word, FUTEX_WAKE, 1, nullptr, nullptr, 0);
  keep(syscall(SYS_gettid));
}

TEST(CatchesNothing, WhereNothingCanWait) {
  if (std::string_view(ARMATURE_SANITIZER) == "realtime") {
    GTEST_SKIP() << "RealtimeSanitizer is stricter: any system call is one too many";
  }
  testing::RealtimeGuard guard;
  EXPECT_EQ(guard.watch(tries_without_waiting), 0u) << guard.report();
}

}  // namespace
}  // namespace armature
