// SPDX-License-Identifier: Apache-2.0
#pragma once

// The process that dies, and what is looked at in the one that lives.

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include <malloc.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "armature/ride/answer.hpp"
#include "waiting.hpp"

namespace kill_restart {

namespace ride = armature::ride;
inline constexpr std::string_view kSanitizer = ARMATURE_SANITIZER;

/// A process of this program that can be killed.
class Child {
 public:
  Child(const std::string& role, const std::string& address, std::uint32_t life) {
    std::string life_text = std::to_string(life);
    std::string words[] = {"/proc/self/exe", role, address, life_text};
    char* arguments[] = {words[0].data(), words[1].data(), words[2].data(), words[3].data(),
                         nullptr};
    if (::posix_spawn(&process_, "/proc/self/exe", nullptr, nullptr, arguments, environ) != 0) {
      fail("no process can be started");
    }
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() { kill(); }

  void kill() {
    if (process_ == 0) return;
    ::kill(process_, SIGKILL);
    int status = 0;
    ::waitpid(process_, &status, 0);
    if (!WIFSIGNALED(status)) fail("a child has ended before it was killed");
    process_ = 0;
  }

 private:
  pid_t process_ = 0;
};

/// What the process that lives has taken.
struct Taken {
  std::size_t memory = 0;  ///< asked for and not given back [byte]
  std::size_t handles = 0;

  /// A connection that is tried at this moment is not counted.
  static Taken now() {
    Taken least{.memory = ~std::size_t{0}, .handles = ~std::size_t{0}};
    for (int i = 0; i < 50; ++i) {
      const auto handles = std::filesystem::directory_iterator("/proc/self/fd");
      least.handles = std::min(
          least.handles, static_cast<std::size_t>(std::distance(begin(handles), end(handles))));
      // A sanitizer's allocator knows leaks better and tells no figures.
      if (kSanitizer.empty()) least.memory = std::min(least.memory, ::mallinfo2().uordblks);
      platform::sleep_until(platform::monotonic_now() + 200us);
    }
    return least;
  }
};

inline void check_level(const Taken& before, const Taken& after) {
  constexpr std::size_t kNoise = 64 * 1024;  // buffers that have met their largest batch later
  if (after.handles != before.handles) {
    fail(std::to_string(before.handles) + " handles became " + std::to_string(after.handles));
  }
  if (kSanitizer.empty() && after.memory > before.memory + kNoise) {
    fail(std::to_string(before.memory) + " bytes became " + std::to_string(after.memory));
  }
  if (kSanitizer.empty()) {
    std::printf("  memory in use %zu -> %zu KiB,", before.memory / 1024, after.memory / 1024);
  }
  std::printf("  handles %zu -> %zu\n", before.handles, after.handles);
}

/// Calls again and again until it is told to end; counts how the calls ended.
class Caller {
 public:
  explicit Caller(std::function<ride::Code()> call)
      : call_(std::move(call)), thread_([this] { run(); }) {}
  /// The connection has ended before.
  void end() {
    goes_on_ = false;
    wait_until([&] { return done_.load(); }, "the end of a call");
    thread_.join();
  }

  std::atomic<std::uint64_t> answered{0};
  std::atomic<std::uint64_t> failed{0};

 private:
  void run() {
    while (goes_on_) {
      const ride::Code code = call_();
      if (code == ride::Code::kDeadline) fail("a call was neither answered nor broken off");
      if (code == ride::Code::kNotConnected) {
        platform::sleep_until(platform::monotonic_now() + 200us);
      } else {
        ++(code == ride::Code::kNone ? answered : failed);
      }
    }
    done_ = true;
  }

  const std::function<ride::Code()> call_;
  std::atomic<bool> goes_on_{true};
  std::atomic<bool> done_{false};
  std::thread thread_;
};

}  // namespace kill_restart
