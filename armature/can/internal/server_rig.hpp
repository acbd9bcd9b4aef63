// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "armature/can/bus_server.hpp"
#include "armature/can/virtual_bus.hpp"
#include "armature/platform/clock.hpp"

// A bus in real time, with a server, as tests need it.

namespace armature::can::internal {

/// A folder that is gone afterwards.
class TestFolder {
 public:
  TestFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "armature-XXXXXX").string();
    EXPECT_NE(mkdtemp(pattern.data()), nullptr);
    path_ = pattern;
  }
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;
  ~TestFolder() { std::filesystem::remove_all(path_); }
  std::string file(const char* name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

/// Waits for what another thread or process does; false if it does not in a long while.
inline bool comes_true_in_time(const std::function<bool()>& condition) {
  constexpr base::Duration kLongWhile = std::chrono::seconds(20);
  const base::Time end = platform::monotonic_now() + kLongWhile;
  while (!condition()) {
    if (platform::monotonic_now() > end) return false;
    platform::sleep_until(platform::monotonic_now() + std::chrono::milliseconds(1));
  }
  return true;
}

/// A virtual bus that a thread advances in real time and serves at a path.
class ServedBus {
 public:
  explicit ServedBus(const std::string& path) {
    base::Diagnostics diagnostics;
    server_ = BusServer::open(bus_, path, diagnostics);
    EXPECT_NE(server_, nullptr) << diagnostics.to_text();
    if (server_) thread_ = std::jthread([this](std::stop_token stop) { run(stop); });
  }
  /// Does something with the bus, in between; what the bus did before has reached its clients.
  void with(const std::function<void(VirtualBus&, BusServer&)>& something) {
    const std::lock_guard lock(mutex_);
    something(bus_, *server_);
  }

 private:
  void run(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      base::Time next = platform::monotonic_now() + std::chrono::milliseconds(5);
      {
        const std::lock_guard lock(mutex_);
        server_->take();
        bus_.advance_to(platform::monotonic_now());
        server_->give();
        next = std::min(next, bus_.next_event().value_or(next));
      }
      server_->wait_until(next);
      std::this_thread::yield();
    }
  }

  VirtualBus bus_{"served", 1'000'000, platform::monotonic_now};
  std::unique_ptr<BusServer> server_;
  std::mutex mutex_;
  std::jthread thread_;
};

}  // namespace armature::can::internal
