// SPDX-License-Identifier: Apache-2.0
#include "armature/can/bus_server.hpp"

#include <array>
#include <cstddef>
#include <memory>
#include <random>
#include <span>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/can/internal/server_rig.hpp"
#include "armature/can/internal/shared_bus_messages.hpp"
#include "armature/can/shared_bus.hpp"
#include "armature/platform/sockets/packet_socket.hpp"

// What hostile and broken clients can do: nothing to the others.

namespace armature::can {
namespace {

using internal::comes_true_in_time;
using internal::ServedBus;
using platform::PacketReceived;
using platform::PacketSent;
using platform::PacketSocket;

constexpr std::uint32_t kBitRate = 1'000'000;

class HostileClients : public ::testing::Test {
 protected:
  std::unique_ptr<PacketSocket> connect() {
    auto connected = PacketSocket::connect(path);
    return connected ? std::move(connected).value() : nullptr;
  }
  std::unique_ptr<PacketSocket> connect_and_say(std::span<const std::byte> packet) {
    std::unique_ptr<PacketSocket> client;
    EXPECT_TRUE(comes_true_in_time([&] { return (client = connect()) != nullptr; }));
    client->send(packet);
    return client;
  }
  static bool is_sent_away(PacketSocket& client) {
    return comes_true_in_time([&client] { return client.other_end_is_gone(); });
  }
  std::size_t clients() {
    std::size_t count = 0;
    served.with([&count](VirtualBus&, BusServer& server) { count = server.clients(); });
    return count;
  }
  /// Frames still go from one client to another.
  void expect_in_order() {
    SharedBus first(path, kBitRate);
    SharedBus second(path, kBitRate);
    base::Diagnostics diagnostics;
    ASSERT_TRUE(comes_true_in_time([&] {
      return first.state() != BusState::kClosed || first.open({}, diagnostics);
    })) << diagnostics.to_text();
    ASSERT_TRUE(comes_true_in_time([&] {
      return second.state() != BusState::kClosed || second.open({}, diagnostics);
    })) << diagnostics.to_text();
    ASSERT_EQ(first.send(data_frame(0x10, {7})), SendStatus::kSent);
    Arrival arrival;
    EXPECT_TRUE(comes_true_in_time([&] {
      return second.receive(arrival) == ReceiveStatus::kReceived &&
             arrival.frame == data_frame(0x10, {7});
    }));
  }

  internal::TestFolder folder;
  const std::string path = folder.file("bus");
  ServedBus served{path};
  const std::vector<std::byte> hello = internal::hello_of({}, kBitRate);
};

TEST_F(HostileClients, GarbageEndsTheirConnectionAndNothingElse) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> byte(0, 255);
  for (const std::size_t size : {1u, 4u, 31u, 32u, 33u, 40u, 6176u, 6177u, 100'000u}) {
    std::vector<std::byte> packet(size);
    for (std::byte& each : packet) each = static_cast<std::byte>(byte(random));
    const auto client = connect_and_say(packet);
    EXPECT_TRUE(is_sent_away(*client)) << size;
  }
  expect_in_order();
}

TEST_F(HostileClients, AnEmptyPacketIsAGoodbye) {
  const auto client = connect_and_say({});
  EXPECT_TRUE(is_sent_away(*client));
  expect_in_order();
}

TEST_F(HostileClients, AfterTheGreetingGarbageEndsTheConnectionToo) {
  internal::ToBusMessage wrong_kind;
  wrong_kind.kind = static_cast<internal::ToBus>(77);
  internal::ToBusMessage wrong_frame;
  wrong_frame.frame.size = 200;
  wrong_frame.frame.kind = 9;
  const std::array<std::byte, 7> short_one{};
  for (const std::span<const std::byte> packet :
       {internal::bytes_of(wrong_kind), internal::bytes_of(wrong_frame),
        std::span<const std::byte>(short_one), std::span<const std::byte>(hello)}) {
    const auto client = connect_and_say(hello);
    ASSERT_TRUE(client->wait_for_packet(platform::monotonic_now() + std::chrono::seconds(20)));
    client->send(packet);
    EXPECT_TRUE(is_sent_away(*client)) << packet.size();
  }
  expect_in_order();
}

TEST_F(HostileClients, WhoSaysNothingIsSentAway) {
  const auto client = connect();
  ASSERT_NE(client, nullptr);
  EXPECT_TRUE(is_sent_away(*client));
}

TEST_F(HostileClients, TimesOutOfThisWorldAreJustOldOrNew) {
  const auto client = connect_and_say(hello);
  ASSERT_TRUE(client->wait_for_packet(platform::monotonic_now() + std::chrono::seconds(20)));
  for (const std::int64_t time : {std::numeric_limits<std::int64_t>::min(), std::int64_t{-1},
                                  std::numeric_limits<std::int64_t>::max()}) {
    internal::ToBusMessage message;
    message.time_ns = time;
    message.frame = internal::to_shared(data_frame(0x700, {}), false);
    ASSERT_EQ(client->send(internal::bytes_of(message)), PacketSent::kYes);
  }
  expect_in_order();
  EXPECT_FALSE(client->other_end_is_gone());
}

TEST_F(HostileClients, AFrameThatIsTooOldIsDiscardedAndCounted) {
  const auto client = connect_and_say(hello);
  ASSERT_TRUE(client->wait_for_packet(platform::monotonic_now() + std::chrono::seconds(20)));
  SharedBus listener(path, kBitRate);
  base::Diagnostics diagnostics;
  ASSERT_TRUE(listener.open({}, diagnostics)) << diagnostics.to_text();
  internal::ToBusMessage message;
  message.time_ns = base::to_ns(platform::monotonic_now() - std::chrono::milliseconds(150));
  message.frame = internal::to_shared(data_frame(0x700, {}), false);
  ASSERT_EQ(client->send(internal::bytes_of(message)), PacketSent::kYes);
  internal::FromBusMessage answer;
  std::size_t size = 0;
  ASSERT_TRUE(comes_true_in_time([&] {
    return client->receive(std::as_writable_bytes(std::span(&answer, 1)), size) ==
               PacketReceived::kYes &&
           answer.status.finished == 1;
  }));
  EXPECT_EQ(answer.status.discarded, 1u);
  Arrival arrival;
  EXPECT_EQ(listener.receive(arrival), ReceiveStatus::kNothing);
}

TEST_F(HostileClients, AFloodHasNoMoreThanItsShareOfTheBus) {
  const auto flood = connect_and_say(hello);
  std::jthread flooding([&flood](const std::stop_token& stop) {
    internal::ToBusMessage message;
    message.frame = internal::to_shared(data_frame(0x700, {}), false);
    while (!stop.stop_requested() &&
           flood->send(internal::bytes_of(message)) != PacketSent::kGone) {
      message.time_ns = base::to_ns(platform::monotonic_now());
    }
  });
  expect_in_order();
  EXPECT_FALSE(flood->other_end_is_gone());
}

TEST_F(HostileClients, WhoNeverReadsLosesItsOwnFramesOnly) {
  const auto deaf = connect_and_say(hello);
  SharedBus sender(path, kBitRate);
  SharedBus receiver(path, kBitRate);
  base::Diagnostics diagnostics;
  ASSERT_TRUE(sender.open({}, diagnostics) && receiver.open({}, diagnostics));
  constexpr std::uint64_t kFrames = 2000;
  Arrival arrival;
  std::uint64_t sent = 0;
  ASSERT_TRUE(comes_true_in_time([&] {
    while (sent < kFrames && sender.send(data_frame(1, {})) == SendStatus::kSent) ++sent;
    while (sender.receive(arrival) == ReceiveStatus::kReceived) continue;
    while (receiver.receive(arrival) == ReceiveStatus::kReceived) continue;
    return receiver.counters().received == kFrames;
  }));
  EXPECT_EQ(receiver.counters().lost, 0u);
}

TEST_F(HostileClients, ThousandsOfConnectionsLeaveNothingBehind) {
  for (int i = 0; i < 3000; ++i) connect();
  std::vector<std::unique_ptr<PacketSocket>> all;
  for (int i = 0; i < 100; ++i) all.push_back(connect());
  EXPECT_LE(clients(), BusServer::kMostClients);
  all.clear();
  ASSERT_TRUE(comes_true_in_time([this] { return clients() == 0; }));
  expect_in_order();
}

TEST_F(HostileClients, WhoComesWhenAllStationsAreTakenIsSentAway) {
  std::vector<std::unique_ptr<SharedBus>> all;
  base::Diagnostics diagnostics;
  for (std::size_t i = 0; i < BusServer::kMostClients; ++i) {
    all.push_back(std::make_unique<SharedBus>(path, kBitRate));
    ASSERT_TRUE(all.back()->open({}, diagnostics)) << diagnostics.to_text();
  }
  SharedBus late(path, kBitRate);
  EXPECT_FALSE(late.open({}, diagnostics));
  EXPECT_THAT(diagnostics.to_text(), testing::HasSubstr("all its stations are taken"));
  all.clear();
  expect_in_order();
}

TEST_F(HostileClients, WhoDiesIsAStationThatIsSilent) {
  auto alone = std::make_unique<SharedBus>(path, kBitRate);
  SharedBus other(path, kBitRate);
  base::Diagnostics diagnostics;
  ASSERT_TRUE(alone->open({}, diagnostics) && other.open({}, diagnostics));
  alone.reset();
  ASSERT_TRUE(comes_true_in_time([this] { return clients() == 1; }));
  ASSERT_EQ(other.send(data_frame(1, {})), SendStatus::kSent);
  served.with([](VirtualBus& bus, BusServer&) { EXPECT_EQ(bus.counters().good, 0u); });
  ASSERT_TRUE(comes_true_in_time([&] {
    Arrival arrival;
    while (other.receive(arrival) == ReceiveStatus::kReceived) continue;
    return other.state() == BusState::kPassive;
  })) << "nobody acknowledges";
}

}  // namespace
}  // namespace armature::can
