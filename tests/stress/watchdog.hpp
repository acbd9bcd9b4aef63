// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <thread>

namespace armature::stress {

/// Ends the process with status 1 when work stands still: generous, since the machine may be busy.
class Watchdog {
 public:
  /// @param progress     changes while the work goes on
  /// @param print_state  says where everything stands, just before the end
  Watchdog(std::function<std::uint64_t()> progress, std::function<void()> print_state)
      : progress_(std::move(progress)),
        print_state_(std::move(print_state)),
        thread_([this] { watch(); }) {}
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;
  ~Watchdog() {
    finished_ = true;
    thread_.join();
  }

 private:
  static constexpr auto kLook = std::chrono::milliseconds(20);
  static constexpr int kLooksWithoutProgress = 60 * 50;  // a minute

  void watch() {
    std::uint64_t last = progress_();
    for (int looks = 0; !finished_; ++looks) {
      std::this_thread::sleep_for(kLook);
      const std::uint64_t now = progress_();
      if (now != last) looks = 0;
      last = now;
      if (looks < kLooksWithoutProgress) continue;
      std::printf("nothing moved for a minute: a wake-up or a message is lost\n");
      print_state_();
      std::fflush(stdout);
      std::_Exit(1);
    }
  }

  std::function<std::uint64_t()> progress_;
  std::function<void()> print_state_;
  std::atomic<bool> finished_{false};
  std::thread thread_;
};

}  // namespace armature::stress
