// SPDX-License-Identifier: Apache-2.0
// The real-time functions of can.
#include <optional>
#include <string>
#include <thread>

#include <unistd.h>

#include "armature/base/fixed_text.hpp"
#include "armature/can/bus.hpp"
#include "armature/can/bus_link.hpp"
#include "armature/can/bus_server.hpp"
#include "armature/can/frame.hpp"
#include "armature/can/shared_bus.hpp"
#include "armature/can/virtual_bus.hpp"
#include "armature/platform/clock.hpp"
#include "tests/realtime/expect_realtime.hpp"

namespace armature::can {
namespace {

TEST(RealtimeCan, Frames) {
  const Frame frame = data_frame(0x123, {1, 2, 3, 4, 5, 6, 7, 8});
  int bits = 0;
  base::Duration time{};
  base::FixedText<32> text;
  expect_realtime("can::frame_bits", [&] { bits = frame_bits(frame); });
  expect_realtime("can::frame_time", [&] { time = frame_time(frame, 1'000'000); });
  expect_realtime("can::to_text", [&] { text = to_text(frame); });
  EXPECT_EQ(time.count(), bits * 1000);
  EXPECT_EQ(text.view(), "123#0102030405060708");
}

TEST(RealtimeCan, Filters) {
  BusOptions options;
  options.filters = {{0x080, 0x7ff, false}, {0x123, 0x7ff, false}};
  bool passed = false;
  expect_realtime("can::passes", [&] { passed = passes(options, data_frame(0x123, {})); });
  EXPECT_TRUE(passed);
}

/// Two open stations; the second answers each frame by itself.
struct Wire {
  Wire() {
    base::Diagnostics diagnostics;
    BusOptions options;
    options.on_news = [this] { answer(); };
    EXPECT_TRUE(host.open({}, diagnostics) && card.open(options, diagnostics));
  }
  void answer() {
    Arrival arrival;
    while (card.receive(arrival) == ReceiveStatus::kReceived) {
      card.send_at(data_frame(0x181, {1}), arrival.time + base::Duration(90'000));
    }
  }
  void advance() { bus.advance_to(now += base::Duration(1'000'000)); }

  base::Time now{};
  VirtualBus bus{"can0", 1'000'000, [this] { return now; }};
  VirtualStation& host = bus.add_station("host");
  VirtualStation& card = bus.add_station("card");
};

TEST(RealtimeCan, AVirtualBus) {
  Wire wire;
  Bus& host = wire.host;
  const Frame sync = data_frame(0x080, {7});
  Arrival arrival;
  std::optional<base::Time> next;
  expect_realtime("Bus::send", [&] { host.send(sync); });
  expect_realtime("VirtualStation::send_at", [&] { wire.host.send_at(sync, wire.now); });
  expect_realtime("VirtualBus::next_event", [&] { next = wire.bus.next_event(); });
  EXPECT_TRUE(next);
  std::size_t waiting = 0;
  expect_realtime("VirtualStation::waiting", [&] { waiting = wire.host.waiting(); });
  EXPECT_EQ(waiting, 64u) << "all it has room for";
  expect_realtime("VirtualBus::advance_to", [&] {
    host.send(sync);
    wire.advance();
  });
  expect_realtime("Bus::receive", [&] { host.receive(arrival); });
  EXPECT_EQ(arrival.frame, data_frame(0x181, {1}));
}

TEST(RealtimeCan, ABusOfAnotherProcess) {
  const std::string path = ::testing::TempDir() + "armature-" + std::to_string(::getpid());
  base::Diagnostics diagnostics;
  VirtualBus bus("bus", 1'000'000, platform::monotonic_now);
  const auto server = BusServer::open(bus, path, diagnostics);
  ASSERT_NE(server, nullptr) << diagnostics.to_text();
  const std::jthread serving([&](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      server->take();
      bus.advance_to(platform::monotonic_now());
      server->give();
      server->wait_until(platform::monotonic_now() + base::Duration(1'000'000));
    }
  });
  SharedBus host(path, 1'000'000);
  SharedBus card(path, 1'000'000);
  ASSERT_TRUE(host.open({}, diagnostics) && card.open({}, diagnostics)) << diagnostics.to_text();
  Arrival arrival;
  expect_realtime("SharedBus::send", [&] { host.send(data_frame(0x080, {7})); });
  while (card.receive(arrival) != ReceiveStatus::kReceived) std::this_thread::yield();
  expect_realtime("SharedBus::receive", [&] { card.receive(arrival); });
  expect_realtime("SharedBus::receive, with the bus's status", [&] { host.receive(arrival); });
  EXPECT_EQ(arrival.frame, data_frame(0x080, {7}));
}

TEST(RealtimeCan, ALinkToABus) {
  BusLink to_nobody("can0", 1'000'000);
  Link& link = to_nobody;
  base::Time now{};
  expect_realtime("Link::begin_run", [&] { link.begin_run(now); });
  expect_realtime("Link::begin_cycle", [&] { link.begin_cycle(now); });
  expect_realtime("Link::now", [&] { now = link.now(); });
  EXPECT_GT(now, base::Time{});
  expect_realtime("Link::wait_for_news", [&] { link.wait_for_news(link.now()); });
}

TEST(RealtimeCan, TheStateOfABus) {
  Wire wire;
  Bus& host = wire.host;
  BusState state{};
  BusCounters counters;
  expect_realtime("Bus::state", [&] { state = host.state(); });
  EXPECT_EQ(state, BusState::kActive);
  int restarted = 0;
  expect_realtime("Bus::restart", [&] {
    wire.host.force_bus_off();
    if (host.restart() == RestartStatus::kRestarting) ++restarted;
    wire.advance();
    wire.advance();
  });
  expect_realtime("Bus::counters", [&] { counters = host.counters(); });
  EXPECT_EQ(restarted, 101);
  EXPECT_EQ(counters.bus_offs, 101u);
}

}  // namespace
}  // namespace armature::can
