// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "armature/can/internal/conformance.hpp"
#include "armature/can/socket_can.hpp"
#include "armature/platform/clock.hpp"

// For tests on the kernel of scripts/test-socketcan. What the kernel does takes its own time, so
// these tests wait for what is to come true, and fail when it does not in a long while.

namespace armature::can::internal {

inline void shell(const std::string& command) {
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
}

inline bool comes_true(const std::function<bool()>& condition) {
  constexpr base::Duration kLongWhile = std::chrono::seconds(2);
  const base::Time end = platform::monotonic_now() + kLongWhile;
  while (!condition()) {
    if (platform::monotonic_now() > end) return false;
    platform::sleep_until(platform::monotonic_now() + std::chrono::milliseconds(1));
  }
  return true;
}

/// Two stations, each on an interface of one bus; it may be the same.
class SocketRig : public BusRig {
 public:
  SocketRig(const std::string& first, const std::string& second)
      : first_(first), second_(second), beside_first_(first), beside_second_(second) {
    base::Diagnostics diagnostics;
    BusOptions all;
    all.own_frames = true;
    EXPECT_TRUE(beside_first_.open(all, diagnostics) && beside_second_.open(all, diagnostics))
        << diagnostics.to_text();
  }
  Bus& first() override { return first_; }
  Bus& second() override { return second_; }

  void settle() override {
    EXPECT_TRUE(wait_for([this] { return heard(beside_first_) && heard(beside_second_); }));
  }
  bool wait_for(const std::function<bool()>& condition) override { return comes_true(condition); }

 private:
  /// Whether one who only listens has heard all that was sent; then the stations have, too.
  bool heard(Bus& listener) {
    Arrival arrival;
    while (listener.receive(arrival) == ReceiveStatus::kReceived) continue;
    return listener.counters().received >= first_.counters().sent + second_.counters().sent;
  }

  SocketCan first_;
  SocketCan second_;
  SocketCan beside_first_;
  SocketCan beside_second_;
};

}  // namespace armature::can::internal
