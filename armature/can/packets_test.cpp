// SPDX-License-Identifier: Apache-2.0
#include "armature/can/packets.hpp"

#include <cstring>

#include <gtest/gtest.h>

#include "armature/can/internal/shared_bus_messages.hpp"

namespace armature::can {
namespace {

constexpr Filter kFilter{.id = 0x406, .mask = 0x41f};

std::uint32_t word_at(const Packets::Bytes& bytes, std::size_t place) {
  std::uint32_t word = 0;
  std::memcpy(&word, &bytes[place], sizeof word);
  return word;
}

TEST(Packets, OfAVirtualBusAreWhatItsServerTakes) {
  const Packets packets = Packets::of("virtual:/tmp/some.bus", 500'000, kFilter);
  EXPECT_TRUE(packets.socket_file);
  EXPECT_EQ(packets.address, "/tmp/some.bus");

  BusOptions options;
  std::uint32_t bit_rate = 0;
  ASSERT_TRUE(internal::parse_hello(packets.hello, options, bit_rate));
  EXPECT_EQ(bit_rate, 500'000u);
  ASSERT_EQ(options.filters.size(), 1u);
  EXPECT_EQ(options.filters[0].mask, kFilter.mask);

  const Frame frame = data_frame(0x401, {0x88, 0, 0, 0});
  const Packets::Bytes sent = packets.to_send(frame);
  ASSERT_EQ(sent.size(), sizeof(internal::ToBusMessage));
  const auto message = internal::message_of<internal::ToBusMessage>(sent);
  EXPECT_EQ(message.kind, internal::ToBus::kFrame);
  EXPECT_EQ(internal::from_shared(message.frame), frame);
  EXPECT_EQ(*packets.time_sent, offsetof(internal::ToBusMessage, time_ns));
}

TEST(Packets, OfAVirtualBusSayWhereAFrameIs) {
  const Packets packets = Packets::of("virtual:/tmp/some.bus", 1'000'000, kFilter);
  internal::FromBusMessage message;
  message.kind = internal::FromBus::kFrame;
  message.frame = internal::to_shared(data_frame(0x426, {0x88, 0, 2, 0}), false);
  const auto bytes = internal::bytes_of(message);
  const Packets::Bytes came(bytes.begin(), bytes.end());
  ASSERT_EQ(packets.size, came.size());
  EXPECT_EQ(word_at(came, *packets.kind), packets.frame_kind);
  EXPECT_EQ(word_at(came, packets.id), 0x426u);
  EXPECT_EQ(static_cast<int>(came[*packets.extended]), 0);
  EXPECT_EQ(static_cast<int>(came[packets.data + 2]), 2);
}

TEST(Packets, OfAnInterfaceAreThoseOfTheKernel) {
  const Packets packets = Packets::of("can0", 1'000'000, kFilter);
  EXPECT_FALSE(packets.socket_file);
  EXPECT_EQ(packets.address, "can0");
  EXPECT_TRUE(packets.hello.empty());
  EXPECT_FALSE(packets.time_sent);
  const Packets::Bytes sent = packets.to_send(data_frame(0x401, {0x88, 0, 3, 0}));
  ASSERT_EQ(sent.size(), 16u);
  EXPECT_EQ(word_at(sent, 0), 0x401u);
  EXPECT_EQ(static_cast<int>(sent[4]), 4);
  EXPECT_EQ(static_cast<int>(sent[packets.data + 2]), 3);
}

}  // namespace
}  // namespace armature::can
