// SPDX-License-Identifier: Apache-2.0
#include "armature/can/shared_bus.hpp"

#include <atomic>
#include <fstream>
#include <memory>
#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/can/internal/server_rig.hpp"
#include "armature/can/make_bus.hpp"
#include "armature/can/socket_can.hpp"

namespace armature::can {
namespace {

using internal::comes_true_in_time;
using internal::ServedBus;
using testing::HasSubstr;

constexpr std::uint32_t kBitRate = 1'000'000;

class SharedBuses : public ::testing::Test {
 protected:
  bool open(Bus& bus, const BusOptions& options = {}) {
    base::Diagnostics diagnostics;
    const bool opened = bus.open(options, diagnostics);
    said = diagnostics.to_text();
    return opened;
  }
  static BusState state_when_read(Bus& bus) {
    Arrival arrival;
    while (bus.receive(arrival) == ReceiveStatus::kReceived) continue;
    return bus.state();
  }

  internal::TestFolder folder;
  const std::string path = folder.file("bus");
  std::string said;
};

TEST_F(SharedBuses, AreChosenByName) {
  EXPECT_EQ(make_bus("can0", kBitRate)->name(), "can0");
  EXPECT_NE(dynamic_cast<SocketCan*>(make_bus("can0", kBitRate).get()), nullptr);
  const auto shared = make_bus("virtual:" + path, kBitRate);
  EXPECT_EQ(shared->name(), "virtual:" + path);
  EXPECT_NE(dynamic_cast<SharedBus*>(shared.get()), nullptr);
}

TEST_F(SharedBuses, WithoutAServerOpeningNamesThePathAndAWayOut) {
  SharedBus bus(path, kBitRate);
  EXPECT_FALSE(open(bus));
  EXPECT_THAT(said, HasSubstr("bus 'virtual:" + path + "'"));
  EXPECT_THAT(said, HasSubstr("no process serves there"));
  EXPECT_THAT(said, HasSubstr("start what has the bus first"));
  EXPECT_EQ(bus.state(), BusState::kClosed);
  SharedBus too_long(std::string(200, 'x'), kBitRate);
  EXPECT_FALSE(open(too_long));
  EXPECT_THAT(said, HasSubstr("letters"));
}

TEST_F(SharedBuses, MoreThanAServerHasRoomForIsAnError) {
  SharedBus bus(path, kBitRate);
  EXPECT_FALSE(open(bus, {.send_capacity = 5000}));
  EXPECT_THAT(said, HasSubstr("at most 4096 frames"));
}

TEST_F(SharedBuses, FramesHaveTheTimeOfTheirEndOnTheBus) {
  ServedBus served(path);
  SharedBus first(path, kBitRate);
  SharedBus second(path, kBitRate);
  ASSERT_TRUE(open(first) && open(second)) << said;
  const base::Time before = platform::monotonic_now();
  ASSERT_EQ(first.send(data_frame(1, {7})), SendStatus::kSent);
  Arrival arrival;
  ASSERT_TRUE(
      comes_true_in_time([&] { return second.receive(arrival) == ReceiveStatus::kReceived; }));
  EXPECT_GE(arrival.time, before + frame_time(data_frame(1, {7}), kBitRate));
  EXPECT_LE(arrival.time, platform::monotonic_now());
}

TEST_F(SharedBuses, AWrongBitRateIsBusOffForWhoSends) {
  ServedBus served(path);
  SharedBus right(path, kBitRate);
  SharedBus wrong(path, 500'000);
  ASSERT_TRUE(open(right) && open(wrong)) << said;
  ASSERT_EQ(wrong.send(data_frame(1, {})), SendStatus::kSent);
  ASSERT_TRUE(comes_true_in_time([&] { return state_when_read(wrong) == BusState::kBusOff; }));
  EXPECT_EQ(wrong.send(data_frame(1, {})), SendStatus::kBusOff);
  EXPECT_EQ(wrong.counters().bus_offs, 1u);
  EXPECT_EQ(wrong.counters().discarded, 1u);
  EXPECT_EQ(state_when_read(right), BusState::kActive);
  EXPECT_EQ(right.counters().received, 0u);
}

TEST_F(SharedBuses, AFullQueueRefusesUntilTheBusHasSentWhatWaits) {
  ServedBus served(path);
  SharedBus alone(path, kBitRate);
  ASSERT_TRUE(open(alone, {.send_capacity = 3})) << said;
  for (std::uint8_t i = 0; i < 3; ++i) {
    ASSERT_EQ(alone.send(data_frame(1, {i})), SendStatus::kSent);
  }
  EXPECT_EQ(alone.send(data_frame(1, {3})), SendStatus::kQueueFull) << "nobody acknowledges";
  SharedBus other(path, kBitRate);
  ASSERT_TRUE(open(other)) << said;
  ASSERT_TRUE(comes_true_in_time([&] {
    state_when_read(alone);
    return alone.send(data_frame(1, {4})) == SendStatus::kSent;
  }));
  ASSERT_TRUE(comes_true_in_time([&] {
    state_when_read(other);
    return other.counters().received == 4;
  }));
  EXPECT_EQ(alone.counters().discarded, 0u);
}

TEST_F(SharedBuses, WhatIsNotReceivedIsCountedAsLost) {
  ServedBus served(path);
  SharedBus sender(path, kBitRate);
  SharedBus sleeper(path, kBitRate);
  ASSERT_TRUE(open(sender) && open(sleeper, {.receive_capacity = 4})) << said;
  constexpr std::uint64_t kFrames = 2000;  // beyond what the kernel keeps, too
  for (std::uint64_t sent = 0; sent < kFrames;) {
    state_when_read(sender);
    if (sender.send(data_frame(1, {})) == SendStatus::kSent) ++sent;
  }
  ASSERT_TRUE(comes_true_in_time([&] {
    state_when_read(sleeper);
    state_when_read(sender);
    const BusCounters counters = sleeper.counters();
    // Where the bus stood still for a tenth of a second, it did not send what was older.
    return counters.received + counters.lost + sender.counters().discarded == kFrames;
  }));
  EXPECT_GT(sleeper.counters().lost, 0u);
}

TEST_F(SharedBuses, AServerThatIsGoneIsNoBusAndANewOneIsFoundByItself) {
  auto served = std::make_unique<ServedBus>(path);
  std::atomic<int> news = 0;
  SharedBus bus(path, kBitRate);
  ASSERT_TRUE(open(bus, {.on_news = [&news] { ++news; }})) << said;
  ASSERT_EQ(bus.send(data_frame(1, {})), SendStatus::kSent);  // nobody acknowledges it
  served.reset();
  ASSERT_TRUE(comes_true_in_time([&news] { return news >= 1; }));
  ASSERT_TRUE(comes_true_in_time([&] { return state_when_read(bus) == BusState::kDown; }));
  EXPECT_EQ(bus.send(data_frame(1, {})), SendStatus::kDown);
  EXPECT_EQ(bus.counters().discarded, 1u);

  served = std::make_unique<ServedBus>(path);
  SharedBus other(path, kBitRate);
  ASSERT_TRUE(open(other)) << said;
  ASSERT_TRUE(comes_true_in_time([&] { return state_when_read(bus) == BusState::kActive; }));
  ASSERT_EQ(bus.send(data_frame(2, {})), SendStatus::kSent);
  Arrival arrival;
  ASSERT_TRUE(
      comes_true_in_time([&] { return other.receive(arrival) == ReceiveStatus::kReceived; }));
  EXPECT_EQ(arrival.frame, data_frame(2, {})) << "what waited does not come later";
}

TEST_F(SharedBuses, AServerTakesThePlaceOfOneThatDied) {
  { std::ofstream file(folder.file("file")); }
  base::Diagnostics diagnostics;
  VirtualBus bus("bus", kBitRate, platform::monotonic_now);
  EXPECT_EQ(BusServer::open(bus, folder.file("file"), diagnostics), nullptr);
  EXPECT_THAT(diagnostics.to_text(), HasSubstr("is not a socket file"));
  ServedBus served(path);
  EXPECT_EQ(BusServer::open(bus, path, diagnostics), nullptr);
  EXPECT_THAT(diagnostics.to_text(), HasSubstr("another process serves there"));
}

}  // namespace
}  // namespace armature::can
