// SPDX-License-Identifier: Apache-2.0
#include <atomic>
#include <cstdint>
#include <thread>

#include <gtest/gtest.h>

#include "armature/can/virtual_bus.hpp"
#include "armature/rt/wakeup.hpp"

namespace armature::can {
namespace {

constexpr std::uint32_t kFrames = 2000;

/// Sends 0, 1, 2, ... and tries again when the queue is full.
void send_all(Bus& bus) {
  for (std::uint32_t i = 0; i < kFrames;) {
    const Frame frame =
        data_frame(0x100, {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(i >> 8)});
    if (bus.send(frame) == SendStatus::kSent) {
      ++i;
    } else {
      std::this_thread::yield();
    }
  }
}

/// Sleeps until there is news, and counts the frames that come in their order.
std::uint32_t receive_all(Bus& bus, rt::Wakeup& news) {
  std::uint32_t in_order = 0;
  Arrival arrival;
  for (std::uint32_t count = 0; count < kFrames;) {
    while (bus.receive(arrival) == ReceiveStatus::kReceived) {
      const std::uint32_t value = arrival.frame.data[0] | arrival.frame.data[1] * 256u;
      if (value == count++) ++in_order;
    }
    if (count < kFrames) news.wait();
  }
  return in_order;
}

TEST(VirtualBusThreads, FramesOfOneThreadWakeAnotherAndKeepTheirOrder) {
  std::atomic<base::Time> now{base::Time{}};
  VirtualBus bus("can0", 1'000'000, [&now] { return now.load(); });
  VirtualStation& sender = bus.add_station("sender");
  VirtualStation& receiver = bus.add_station("receiver");
  rt::Wakeup news;
  BusOptions options;
  options.receive_capacity = kFrames;
  options.on_news = [&news] { news.notify(); };
  base::Diagnostics diagnostics;
  ASSERT_TRUE(sender.open({}, diagnostics) && receiver.open(options, diagnostics));

  std::atomic<bool> done{false};
  std::uint32_t in_order = 0;
  std::thread sending([&] { send_all(sender); });
  std::thread receiving([&] {
    in_order = receive_all(receiver, news);
    done = true;
  });
  while (!done) {
    now = now.load() + base::Duration(50'000);
    bus.advance_to(now);
    std::this_thread::yield();
  }
  sending.join();
  receiving.join();
  EXPECT_EQ(in_order, kFrames);
  EXPECT_EQ(sender.counters().sent, kFrames);
  EXPECT_EQ(receiver.counters().received, kFrames);
  EXPECT_EQ(receiver.counters().lost, 0u);
}

}  // namespace
}  // namespace armature::can
