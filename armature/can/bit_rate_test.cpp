// SPDX-License-Identifier: Apache-2.0
#include <chrono>

#include <gtest/gtest.h>

#include "armature/can/virtual_bus.hpp"

// A station with another bit rate than its bus.

namespace armature::can {
namespace {

using namespace std::chrono_literals;

constexpr Frame kFrame = data_frame(0x123, {1, 2, 3});

class WrongBitRate : public ::testing::Test {
 protected:
  WrongBitRate() {
    base::Diagnostics diagnostics;
    for (VirtualStation* station : {&good, &better, &wrong}) {
      EXPECT_TRUE(station->open({}, diagnostics)) << diagnostics.to_text();
    }
    wrong.set_bit_rate(500'000);
  }
  void advance(base::Duration by) { bus.advance_to(now += by); }
  static int received(Bus& station) {
    int count = 0;
    Arrival arrival;
    while (station.receive(arrival) == ReceiveStatus::kReceived) ++count;
    return count;
  }

  base::Time now{};
  VirtualBus bus{"can0", 1'000'000, [this] { return now; }};
  VirtualStation& good = bus.add_station("good");
  VirtualStation& better = bus.add_station("better");
  VirtualStation& wrong = bus.add_station("wrong");
};

TEST_F(WrongBitRate, WhoSendsGoesBusOffAndNobodyHearsIt) {
  ASSERT_EQ(wrong.send(kFrame), SendStatus::kSent);
  advance(100ms);
  EXPECT_EQ(wrong.state(), BusState::kBusOff);
  EXPECT_EQ(wrong.counters().discarded, 1u);
  EXPECT_EQ(received(good), 0);
  EXPECT_EQ(good.state(), BusState::kActive);
  EXPECT_EQ(good.counters().error_frames, 32u);
  EXPECT_EQ(bus.counters().corrupted, 32u);
}

TEST_F(WrongBitRate, WhoListensDestroysWhatOthersSendUntilItIsPassive) {
  ASSERT_EQ(good.send(kFrame), SendStatus::kSent);
  advance(100ms);
  EXPECT_EQ(wrong.state(), BusState::kPassive);
  EXPECT_EQ(received(wrong), 0);
  EXPECT_EQ(received(better), 1) << "in the end";
  EXPECT_EQ(bus.counters().corrupted, 15u);
  EXPECT_EQ(good.state(), BusState::kActive);
  ASSERT_EQ(good.send(kFrame), SendStatus::kSent);
  advance(100ms);
  EXPECT_EQ(bus.counters().corrupted, 15u) << "a passive station destroys nothing";
  EXPECT_EQ(wrong.state(), BusState::kPassive) << "it still understands nothing";
}

TEST_F(WrongBitRate, ItAcknowledgesNobody) {
  better.set_dead(true);
  wrong.set_dead(false);
  ASSERT_EQ(good.send(kFrame), SendStatus::kSent);
  advance(100ms);
  EXPECT_EQ(good.counters().received, 0u);
  EXPECT_EQ(bus.counters().good, 0u);
  EXPECT_GT(bus.counters().not_acknowledged, 0u) << "once the wrong one is passive";
}

TEST_F(WrongBitRate, WithTheRightOneAgainItTakesPart) {
  wrong.set_bit_rate(1'000'000);
  ASSERT_EQ(wrong.send(kFrame), SendStatus::kSent);
  advance(1ms);
  EXPECT_EQ(received(good), 1);
}

}  // namespace
}  // namespace armature::can
