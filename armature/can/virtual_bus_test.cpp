// SPDX-License-Identifier: Apache-2.0
#include "armature/can/virtual_bus.hpp"

#include <chrono>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::can {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr Frame kSync = data_frame(0x080, {7});  // 59 bits
constexpr base::Duration kSyncTime = 59us;
constexpr base::Duration kBit = 1us;

/// A bus at 1 Mbit/s with stations that are open, and everything that was on its wire.
class Scene {
 public:
  explicit Scene(SendOrder order = SendOrder::kFirst) {
    for (const char* name : {"host", "card1", "card2"}) bus.add_station(name, order);
    bus.set_tap([this](const WireEvent& event) { note(event); });
  }
  VirtualStation& open(VirtualStation& station, const BusOptions& options = {}) {
    base::Diagnostics diagnostics;
    EXPECT_TRUE(station.open(options, diagnostics)) << diagnostics.to_text();
    return station;
  }
  void advance_to(base::Duration time) {
    bus.advance_to(base::Time(time));
    now = base::Time(time);
  }
  std::vector<std::string> take_log() { return std::exchange(log, {}); }

  base::Time now{};
  std::vector<std::string> log;
  VirtualBus bus{"can0", 1'000'000, [this] { return now; }};

 private:
  void note(const WireEvent& event) {
    static constexpr const char* kOutcomes[] = {"", " corrupted", " unheard", " lost", " aborted"};
    const auto us = [](base::Time time) { return std::to_string(time.time_since_epoch() / 1us); };
    log.push_back(us(event.begin) + "-" + us(event.end) + " " +
                  std::string(to_text(event.frame).view()) +
                  kOutcomes[static_cast<int>(event.outcome)]);
  }
};

struct Stations : Scene {
  explicit Stations(SendOrder order = SendOrder::kFirst)
      : Scene(order),
        host(open(bus.add_station("a", order))),
        card(open(bus.add_station("b", order))),
        other(open(bus.add_station("c", order))) {}
  VirtualStation& host;
  VirtualStation& card;
  VirtualStation& other;
};

TEST(VirtualBus, AFrameArrivesExactlyAtItsEnd) {
  Stations scene;
  scene.advance_to(100us);
  ASSERT_EQ(scene.host.send(kSync), SendStatus::kSent);
  Arrival arrival;
  scene.advance_to(100us + kSyncTime - 1ns);
  EXPECT_EQ(scene.card.receive(arrival), ReceiveStatus::kNothing);
  scene.advance_to(100us + kSyncTime);
  ASSERT_EQ(scene.card.receive(arrival), ReceiveStatus::kReceived);
  EXPECT_EQ(arrival.time, base::Time(100us + kSyncTime));
  EXPECT_EQ(arrival.frame, kSync);
  EXPECT_EQ(scene.other.receive(arrival), ReceiveStatus::kReceived);
  EXPECT_EQ(scene.host.receive(arrival), ReceiveStatus::kNothing);
}

TEST(VirtualBus, WhatIsSentAtOneTimeCompetesInWhateverOrderItWasSent) {
  Stations scene;
  scene.advance_to(0us);
  scene.other.send(data_frame(0x300, {}));
  scene.host.send(data_frame(0x7ff, {}));
  scene.advance_to(0us);
  scene.card.send(kSync);
  scene.advance_to(1ms);
  EXPECT_THAT(scene.take_log(), ElementsAre("0-59 080#07", "59-110 300#", "110-160 7FF#"));
  EXPECT_EQ(scene.bus.counters().busy, 160us);
  EXPECT_EQ(scene.bus.counters().good, 3u);
}

TEST(VirtualBus, AFrameOnTheWireIsNotInterruptedByAMoreUrgentOne) {
  Stations scene;
  scene.host.send(data_frame(0x7ff, {}));
  scene.advance_to(1us);
  scene.card.send(kSync);
  scene.advance_to(1ms);
  EXPECT_THAT(scene.take_log(), ElementsAre("0-50 7FF#", "50-109 080#07"));
}

TEST(VirtualBus, AStationSendsFirstComeFirstServedOrByUrgency) {
  for (const auto order : {SendOrder::kFirst, SendOrder::kMostUrgent}) {
    Stations scene(order);
    scene.host.send(data_frame(0x7ff, {}));
    scene.host.send(kSync);
    scene.card.send(data_frame(0x300, {}));
    scene.advance_to(1ms);
    const auto log = scene.take_log();
    if (order == SendOrder::kFirst) {
      EXPECT_THAT(log, ElementsAre("0-51 300#", "51-101 7FF#", "101-160 080#07"));
    } else {
      EXPECT_THAT(log, ElementsAre("0-59 080#07", "59-110 300#", "110-160 7FF#"));
    }
  }
}

TEST(VirtualBus, ADeviceAnswersFromWithinTheNewsAtItsOwnTime) {
  Scene scene;
  VirtualStation& host = scene.open(scene.bus.add_station("a"));
  VirtualStation& card = scene.bus.add_station("b");
  BusOptions options;
  options.on_news = [&] {
    Arrival arrival;
    while (card.receive(arrival) == ReceiveStatus::kReceived) {
      card.send_at(data_frame(0x300, {}), arrival.time + 90us);
    }
  };
  scene.open(card, options);
  host.send(kSync);
  scene.now = base::Time(10ms);
  scene.advance_to(10ms);
  EXPECT_THAT(scene.take_log(), ElementsAre("0-59 080#07", "149-200 300#"));
  card.delay_by(1ms);
  host.send(kSync);
  scene.advance_to(20ms);
  EXPECT_THAT(scene.take_log(), ElementsAre("10000-10059 080#07", "11149-11200 300#"));
}

TEST(VirtualBus, WhatReachesTheBusLateBeginsWhenItIsThere) {
  Stations scene;
  scene.bus.advance_to(base::Time(1ms));
  scene.host.send(kSync);  // by a clock that still shows 0
  scene.advance_to(2ms);
  EXPECT_THAT(scene.take_log(), ElementsAre("1000-1059 080#07"));
}

TEST(VirtualBus, KnowsWhenSomethingWillHappen) {
  Stations scene;
  EXPECT_EQ(scene.bus.next_event(), std::nullopt);
  scene.host.send_at(kSync, base::Time(2ms));
  EXPECT_EQ(scene.bus.next_event(), base::Time(2ms + kSyncTime));
  scene.advance_to(2ms + 1us);
  EXPECT_EQ(scene.bus.next_event(), base::Time(2ms + kSyncTime));
  scene.advance_to(3ms);
  EXPECT_EQ(scene.bus.next_event(), std::nullopt);
}

TEST(VirtualBus, AFullQueueRefusesAndCounts) {
  Scene scene;
  BusOptions small;
  small.send_capacity = 2;
  small.receive_capacity = 1;
  VirtualStation& host = scene.open(scene.bus.add_station("a"), small);
  VirtualStation& card = scene.open(scene.bus.add_station("b"), small);
  EXPECT_EQ(host.send(kSync), SendStatus::kSent);
  EXPECT_EQ(host.send(kSync), SendStatus::kSent);
  EXPECT_EQ(host.send(kSync), SendStatus::kQueueFull);
  scene.advance_to(kSyncTime);
  EXPECT_EQ(host.send(kSync), SendStatus::kSent) << "one has left the queue";
  EXPECT_EQ(host.send(kSync), SendStatus::kQueueFull);
  scene.advance_to(1ms);
  EXPECT_EQ(host.counters().sent, 3u);
  EXPECT_EQ(host.counters().refused, 2u);
  EXPECT_EQ(card.counters().received, 1u);
  EXPECT_EQ(card.counters().lost, 2u);
}

TEST(VirtualBus, ALostFrameIsCountedWhereItIsMissed) {
  Stations scene;
  scene.bus.lose_next(1, Filter{0x300, 0x7ff, false});
  scene.host.send(kSync);
  scene.host.send(data_frame(0x300, {}));
  scene.host.send(data_frame(0x300, {}));
  scene.advance_to(1ms);
  EXPECT_THAT(scene.take_log(), ElementsAre("0-59 080#07", "59-110 300# lost", "110-161 300#"));
  EXPECT_EQ(scene.card.counters().received, 2u);
  EXPECT_EQ(scene.card.counters().lost, 1u);
  EXPECT_EQ(scene.other.counters().lost, 1u);
  EXPECT_EQ(scene.host.counters().lost, 0u);
}

TEST(VirtualBus, ACorruptedFrameIsEndedByAnErrorFrameAndSentAgain) {
  Stations scene;
  scene.bus.corrupt_next(1);
  scene.host.send(kSync);
  scene.advance_to(1ms);
  // 59 - 13 bits up to the checksum, then 7 of the flags, 8 of the delimiter, 3 between frames.
  EXPECT_THAT(scene.take_log(), ElementsAre("0-64 080#07 corrupted", "64-123 080#07"));
  EXPECT_EQ(scene.host.send_errors(), 7) << "8 for the error, less 1 for the good frame";
  EXPECT_EQ(scene.card.receive_errors(), 0) << "1, less 1";
  EXPECT_EQ(scene.card.counters().received, 1u);
  EXPECT_EQ(scene.card.counters().error_frames, 1u);
  EXPECT_EQ(scene.host.counters().error_frames, 1u);
}

TEST(VirtualBus, ErrorsMakeASenderPassiveThenBusOff) {
  Stations scene;
  scene.bus.corrupt_next(15);
  scene.host.send(kSync);
  scene.advance_to(15 * 64us);
  EXPECT_EQ(scene.host.send_errors(), 120);
  EXPECT_EQ(scene.host.state(), BusState::kActive);
  scene.bus.corrupt_next(17);
  scene.advance_to(16 * 64us);
  EXPECT_EQ(scene.host.send_errors(), 128);
  EXPECT_EQ(scene.host.state(), BusState::kPassive);
  EXPECT_EQ(scene.card.receive_errors(), 16);
  // A passive sender waits for eight more bits.
  scene.advance_to(16 * 64us + 15 * (64us + 8 * kBit));
  EXPECT_EQ(scene.host.send_errors(), 248);
  EXPECT_EQ(scene.host.state(), BusState::kPassive);
  scene.host.send(kSync);
  scene.advance_to(16 * 64us + 16 * (64us + 8 * kBit));
  EXPECT_EQ(scene.host.state(), BusState::kBusOff);
  EXPECT_EQ(scene.host.counters().discarded, 2u) << "nothing old comes out later";
  EXPECT_EQ(scene.host.send(kSync), SendStatus::kBusOff);
  scene.advance_to(1s);
  EXPECT_EQ(scene.bus.counters().corrupted, 32u);
  EXPECT_EQ(scene.bus.counters().good, 0u);
  EXPECT_EQ(scene.host.state(), BusState::kBusOff) << "does not come back by itself";
}

TEST(VirtualBus, RecoveryTakes128Times11RecessiveBits) {
  Stations scene;
  scene.host.force_bus_off();
  scene.advance_to(1ms);
  EXPECT_EQ(scene.host.restart(), RestartStatus::kRestarting);
  const base::Duration recovered = 1ms + 128 * 11 * kBit;
  EXPECT_EQ(scene.bus.next_event(), base::Time(recovered));
  scene.advance_to(recovered - 1ns);
  EXPECT_EQ(scene.host.state(), BusState::kBusOff);
  scene.advance_to(recovered);
  EXPECT_EQ(scene.host.state(), BusState::kActive);
  EXPECT_EQ(scene.host.send_errors(), 0);
}

TEST(VirtualBus, RecoveryOnABusyBusCountsTheEndsOfFrames) {
  Stations scene;
  scene.host.force_bus_off();
  scene.host.restart();
  // Two sequences of 11 bits pass, then ten frames, each of which ends with one.
  for (int i = 0; i < 10; ++i) scene.card.send_at(kSync, base::Time(25us));
  scene.advance_to(25us + 10 * kSyncTime);
  EXPECT_EQ(scene.bus.next_event(), base::Time(25us + 10 * kSyncTime + (128 - 12) * 11 * kBit));
}

TEST(VirtualBus, AloneOnACutBusASenderBecomesPassiveButNeverBusOff) {
  Stations scene;
  scene.bus.set_cut(true);
  scene.host.send(kSync);
  // 59 - 13 bits, then 2 to the missing acknowledgement, 6 of the flag, 8, 3.
  scene.advance_to(65us);
  EXPECT_THAT(scene.take_log(), ElementsAre("0-65 080#07 unheard"));
  EXPECT_EQ(scene.host.send_errors(), 8);
  scene.advance_to(1s);
  EXPECT_EQ(scene.host.state(), BusState::kPassive);
  EXPECT_EQ(scene.host.send_errors(), 128);
  EXPECT_EQ(scene.card.counters().received, 0u);
  scene.bus.set_cut(false);
  scene.advance_to(2s);
  EXPECT_EQ(scene.card.counters().received, 1u) << "it is sent as soon as somebody is there";
  EXPECT_EQ(scene.host.state(), BusState::kActive);
}

TEST(VirtualBus, ADeadStationIsNotThereAndDoesNotKnowIt) {
  Stations scene;
  scene.card.set_dead(true);
  scene.host.send(kSync);
  EXPECT_EQ(scene.card.send(kSync), SendStatus::kSent);
  scene.advance_to(1ms);
  EXPECT_THAT(scene.take_log(), ElementsAre("0-59 080#07"));
  EXPECT_EQ(scene.card.counters().received, 0u);
  scene.other.close();
  scene.host.send(kSync);
  scene.advance_to(1ms + 65us);
  EXPECT_THAT(scene.take_log(), ElementsAre("1000-1065 080#07 unheard"));
}

TEST(VirtualBus, WhoGoesOffInTheMiddleOfAFrameDoesNotCompleteIt) {
  Stations scene;
  scene.host.send(kSync);
  scene.advance_to(30us);
  scene.host.close();
  scene.advance_to(1ms);
  EXPECT_THAT(scene.take_log(), ElementsAre("0-59 080#07 aborted"));
  EXPECT_EQ(scene.card.counters().received, 0u);
  EXPECT_EQ(scene.host.counters().discarded, 1u);
}

TEST(VirtualBus, TwoSendersOfOneIdentifierAtOnceAreCounted) {
  Stations scene;
  scene.host.send(kSync);
  scene.card.send(kSync);
  scene.advance_to(1ms);
  EXPECT_EQ(scene.bus.counters().collisions, 1u);
  EXPECT_EQ(scene.bus.counters().good, 2u);
}

TEST(VirtualBus, ErrorFramesAreReceivedIfAskedFor) {
  Scene scene;
  BusOptions options;
  options.error_frames = true;
  scene.open(scene.bus.add_station("a"), options).force_bus_off();
  VirtualStation& card = scene.open(scene.bus.add_station("b"), options);
  VirtualStation& host = scene.open(scene.bus.add_station("c"));
  scene.bus.corrupt_next(1);
  host.send(kSync);
  scene.advance_to(1ms);
  Arrival arrival;
  ASSERT_EQ(card.receive(arrival), ReceiveStatus::kReceived);
  EXPECT_EQ(arrival.frame.kind, FrameKind::kError);
  EXPECT_EQ(arrival.frame.id, error_class::kProtocol | error_class::kBusError);
  EXPECT_EQ(arrival.time, base::Time(64us));
  ASSERT_EQ(card.receive(arrival), ReceiveStatus::kReceived);
  EXPECT_EQ(arrival.frame, kSync);
}

/// Twenty milliseconds of random sending, with faults, as a log.
std::vector<std::string> random_run(unsigned seed, base::Duration step) {
  Stations scene(SendOrder::kMostUrgent);
  std::mt19937 random(seed);
  VirtualStation* const stations[] = {&scene.host, &scene.card, &scene.other};
  for (int i = 0; i < 300; ++i) {
    const base::Time at(base::Duration(random() % 20'000'000));
    const auto id = static_cast<std::uint32_t>(3 * (random() % 600) + static_cast<unsigned>(i % 3));
    stations[i % 3]->send_at(data_frame(id, {static_cast<std::uint8_t>(random())}), at);
    if (i % 50 == 0) scene.bus.corrupt_next(3);
  }
  while (scene.now < base::Time(100ms)) scene.advance_to(scene.now.time_since_epoch() + step);
  return scene.take_log();
}

TEST(VirtualBus, EqualRunsAreEqualWhateverTheStepsOfTime) {
  const auto log = random_run(1, 1ms);
  EXPECT_GT(log.size(), 190u);
  EXPECT_EQ(random_run(1, 1ms), log);
  EXPECT_EQ(random_run(1, 7us), log);
  EXPECT_EQ(random_run(1, 100ms), log);
  EXPECT_NE(random_run(2, 1ms), log);
}

}  // namespace
}  // namespace armature::can
