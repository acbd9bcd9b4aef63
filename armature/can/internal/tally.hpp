// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>

#include "armature/can/bus.hpp"

namespace armature::can::internal {

/// The counters of a bus while they are counted, by the threads that send, receive and run the bus.
struct Tally {
  using Counter = std::atomic<std::uint64_t>;

  Counter sent{0};
  Counter refused{0};
  Counter discarded{0};
  Counter received{0};
  Counter lost{0};
  Counter error_frames{0};
  Counter bus_offs{0};

  /// Counts what becomes of a frame that is to be sent.
  SendStatus answer(SendStatus status) {
    add(status == SendStatus::kSent ? sent : refused);
    return status;
  }
  static void add(Counter& counter, std::uint64_t by = 1) {
    counter.fetch_add(by, std::memory_order_relaxed);
  }
  /// What `bus` has received and nobody took, when it is closed.
  void lose_unread(Bus& bus) {
    Arrival unread;
    while (bus.receive(unread) == ReceiveStatus::kReceived) {
      received.fetch_sub(1, std::memory_order_relaxed);
      add(lost);
    }
  }
  BusCounters now() const {
    const auto read = [](const Counter& counter) {
      return counter.load(std::memory_order_relaxed);
    };
    return {.sent = read(sent),
            .refused = read(refused),
            .discarded = read(discarded),
            .received = read(received),
            .lost = read(lost),
            .error_frames = read(error_frames),
            .bus_offs = read(bus_offs)};
  }
};

}  // namespace armature::can::internal
