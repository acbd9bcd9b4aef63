// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/sockets/packet_socket.hpp"

#include <array>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/platform/clock.hpp"

namespace armature::platform {
namespace {

using testing::HasSubstr;

std::span<const std::byte> bytes_of(const std::string& text) {
  return std::as_bytes(std::span(text));
}

class Packets : public ::testing::Test {
 protected:
  Packets() {
    std::string pattern = (std::filesystem::temp_directory_path() / "armature-XXXXXX").string();
    EXPECT_NE(mkdtemp(pattern.data()), nullptr);
    folder = pattern;
    path = folder + "/socket";
  }
  ~Packets() override { std::filesystem::remove_all(folder); }
  void listen(std::size_t places = 2) { server = PacketServer::listen(path, places).value(); }
  static base::Time soon() { return monotonic_now() + std::chrono::seconds(20); }

  std::string folder;
  std::string path;
  std::unique_ptr<PacketServer> server;
  std::array<std::byte, 8> room{};
  std::size_t size = 0;
};

TEST_F(Packets, StayWholeAndInTheirOrderBothWays) {
  listen();
  const auto client = PacketSocket::connect(path).value();
  server->wait_until(soon());
  const std::size_t place = server->accept();
  ASSERT_EQ(place, 0u);
  ASSERT_EQ(client->send(bytes_of("one")), PacketSent::kYes);
  ASSERT_EQ(client->send(bytes_of("three")), PacketSent::kYes);
  server->wait_until(soon());
  ASSERT_EQ(server->receive(place, room, size), PacketReceived::kYes);
  EXPECT_EQ(size, 3u);
  ASSERT_EQ(server->receive(place, room, size), PacketReceived::kYes);
  EXPECT_EQ(size, 5u);
  EXPECT_EQ(server->receive(place, room, size), PacketReceived::kNothing);
  ASSERT_EQ(server->send(place, bytes_of("more than room")), PacketSent::kYes);
  ASSERT_TRUE(client->wait_for_packet(soon()));
  ASSERT_EQ(client->receive(room, size), PacketReceived::kYes);
  EXPECT_EQ(size, 14u) << "what was cut off is told";
}

TEST_F(Packets, TheEndOfOneIsKnownToTheOther) {
  listen();
  auto client = PacketSocket::connect(path).value();
  ASSERT_EQ(server->accept(), 0u);
  client.reset();
  server->wait_until(soon());
  EXPECT_EQ(server->receive(0, room, size), PacketReceived::kGone);
  server->drop(0);
  EXPECT_FALSE(server->taken(0));

  client = PacketSocket::connect(path).value();
  ASSERT_EQ(server->accept(), 0u) << "the place is empty again";
  EXPECT_FALSE(client->other_end_is_gone());
  server.reset();
  EXPECT_TRUE(client->other_end_is_gone());
  EXPECT_EQ(client->receive(room, size), PacketReceived::kGone);
  EXPECT_EQ(client->send(bytes_of("x")), PacketSent::kGone);
}

TEST_F(Packets, WhoComesWhenAllPlacesAreTakenIsSentAway) {
  listen(1);
  const auto first = PacketSocket::connect(path).value();
  ASSERT_EQ(server->accept(), 0u);
  const auto second = PacketSocket::connect(path).value();
  EXPECT_EQ(server->accept(), server->places());
  EXPECT_TRUE(second->other_end_is_gone());
  EXPECT_FALSE(first->other_end_is_gone());
}

TEST_F(Packets, AFullSocketSaysSoAndWaitsForRoom) {
  listen();
  const auto client = PacketSocket::connect(path).value();
  ASSERT_EQ(server->accept(), 0u);
  while (server->send(0, bytes_of("12345678")) == PacketSent::kYes) continue;
  EXPECT_EQ(server->send(0, bytes_of("12345678")), PacketSent::kFull);
  server->set_wants_to_send(0, true);
  while (client->receive(room, size) == PacketReceived::kYes) continue;
  server->wait_until(soon());
  EXPECT_EQ(server->send(0, bytes_of("12345678")), PacketSent::kYes);
}

TEST_F(Packets, AConnectionIsMadeAnewWithoutItsThreadsBeingTold) {
  listen();
  const auto client = PacketSocket::connect(path).value();
  server.reset();
  EXPECT_FALSE(client->try_reconnect());
  EXPECT_TRUE(client->wait()) << "the end is news";
  listen();
  ASSERT_TRUE(client->try_reconnect());
  ASSERT_EQ(server->accept(), 0u);
  ASSERT_EQ(server->send(0, bytes_of("hello")), PacketSent::kYes);
  EXPECT_TRUE(client->wait());
  ASSERT_EQ(client->receive(room, size), PacketReceived::kYes);
  EXPECT_EQ(size, 5u);
}

TEST_F(Packets, AnInterruptionEndsEveryWait) {
  listen();
  const auto client = PacketSocket::connect(path).value();
  std::thread other([&client] { client->interrupt(); });
  while (client->wait()) continue;
  EXPECT_FALSE(client->pause(std::chrono::hours(1)));
  other.join();
}

TEST_F(Packets, AServerTakesThePlaceOfOneThatLeftItsFile) {
  EXPECT_THAT(PacketSocket::connect(path).error(), HasSubstr("no process serves there"));
  listen();
  const std::string error = PacketServer::listen(path, 1).error();
  EXPECT_THAT(error, HasSubstr("another process serves there"));
  std::filesystem::create_hard_link(path, path + ".left");
  server.reset();
  EXPECT_FALSE(std::filesystem::exists(path)) << "in order, nothing is left";
  std::filesystem::rename(path + ".left", path);
  EXPECT_TRUE(PacketServer::listen(path, 1));
}

}  // namespace
}  // namespace armature::platform
