// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/protocol/puck_protocol.hpp"

#include <algorithm>
#include <cmath>

namespace armature::wam {
namespace {

constexpr std::uint32_t kGroupBit = 0x400;
constexpr std::uint32_t kNodeBits = 0x1f;
constexpr std::uint8_t kSetBit = 0x80;
constexpr std::uint8_t kNumberBits = 0x7f;
constexpr std::uint8_t kPositionBits = 0x3f;  // of the first byte
constexpr std::size_t kPositionBytes = 3;
constexpr int kTorqueBits = 14;

std::uint8_t set_byte(int number) { return static_cast<std::uint8_t>(kSetBit | number); }

/// Of the lower `bits` of a word, the uppermost is the sign.
std::int32_t sign_extended(std::uint32_t word, int bits) {
  const int unused = 32 - bits;
  return static_cast<std::int32_t>(word << unused) >> unused;
}

std::int32_t value_of(const can::Frame& frame) {
  const std::size_t bytes = frame.size - 2u;
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < bytes; ++i) {
    word |= static_cast<std::uint32_t>(frame.data[2 + i]) << 8 * i;
  }
  return sign_extended(word, static_cast<int>(8 * bytes));
}

void put_position(can::Frame& frame, std::int32_t counts, PositionFlags flags) {
  const auto word = static_cast<std::uint32_t>(counts);
  const auto upper = static_cast<std::uint8_t>(word >> 16 & kPositionBits);
  frame.data[frame.size++] = static_cast<std::uint8_t>(upper | static_cast<std::uint8_t>(flags));
  frame.data[frame.size++] = static_cast<std::uint8_t>(word >> 8);
  frame.data[frame.size++] = static_cast<std::uint8_t>(word);
}

std::int32_t position_at(const can::Frame& frame, std::size_t begin) {
  const auto byte = [&](std::size_t i) {
    return static_cast<std::uint32_t>(frame.data[begin + i]);
  };
  return sign_extended((byte(0) & kPositionBits) << 16 | byte(1) << 8 | byte(2), 22);
}

}  // namespace

std::optional<Address> address_of(const can::Frame& frame) {
  if (frame.extended || frame.kind != can::FrameKind::kData) return std::nullopt;
  return Address{static_cast<int>(frame.id >> 5 & kNodeBits),
                 static_cast<int>(frame.id & kNodeBits), (frame.id & kGroupBit) != 0};
}

can::Frame get_frame(const Address& address, int number) {
  return can::data_frame(identifier(address), {static_cast<std::uint8_t>(number)});
}

can::Frame set_frame(const Address& address, int number, std::int32_t value, Width width) {
  can::Frame frame = can::data_frame(identifier(address), {set_byte(number), 0});
  const int bytes = width == Width::kFour ? 4 : 2;
  for (int i = 0; i < bytes; ++i) {
    frame.data[frame.size++] =
        static_cast<std::uint8_t>(static_cast<std::uint32_t>(value) >> 8 * i);
  }
  return frame;
}

can::Frame reply_frame(int node, int number, std::int32_t value, Width width) {
  return set_frame(from_node(node, Group::kReplies), number, value, width);
}

std::optional<Message> parse_message(const can::Frame& frame) {
  if (frame.size == 0) return std::nullopt;
  const bool set = (frame.data[0] & kSetBit) != 0;
  const int number = frame.data[0] & kNumberBits;
  if (!set) return frame.size == 1 ? std::optional(Message{false, number, 0}) : std::nullopt;
  if ((frame.size != 4 && frame.size != 6) || frame.data[1] != 0) return std::nullopt;
  return Message{true, number, value_of(frame)};
}

std::optional<std::int32_t> parse_reply(const can::Frame& frame, int number) {
  const std::optional<Message> message = parse_message(frame);
  if (!message || !message->set || message->number != number) return std::nullopt;
  return message->value;
}

can::Frame position_frame(int node, const Positions& positions, PositionFlags flags) {
  can::Frame frame = can::data_frame(identifier(from_node(node, Group::kPositions)), {});
  put_position(frame, positions.motor, flags);
  if (positions.joint) put_position(frame, *positions.joint, flags);
  return frame;
}

can::Frame joint_position_frame(int node, std::int32_t counts, PositionFlags flags) {
  can::Frame frame = can::data_frame(identifier(from_node(node, Group::kJointPositions)), {});
  put_position(frame, counts, flags);
  return frame;
}

std::optional<Positions> parse_positions(const can::Frame& frame) {
  if (frame.size != kPositionBytes && frame.size != 2 * kPositionBytes) return std::nullopt;
  Positions positions{position_at(frame, 0), std::nullopt};
  if (frame.size == 2 * kPositionBytes) positions.joint = position_at(frame, kPositionBytes);
  return positions;
}

std::int16_t torque_value(double units) {
  if (std::isnan(units)) return 0;
  constexpr double kMost = kMostTorque;
  return static_cast<std::int16_t>(std::floor(std::clamp(units, -kMost, kMost)));
}

can::Frame torque_frame(Group group, int number, const Torques& torques) {
  std::uint64_t bits = 0;
  for (const std::int16_t torque : torques) {
    bits = bits << kTorqueBits | (static_cast<std::uint64_t>(torque) & ((1u << kTorqueBits) - 1));
  }
  can::Frame frame = can::data_frame(identifier(to_group(group)), {set_byte(number)});
  for (int byte = 6; byte >= 0; --byte) {
    frame.data[frame.size++] = static_cast<std::uint8_t>(bits >> 8 * byte);
  }
  return frame;
}

std::optional<Torques> parse_torques(const can::Frame& frame, int number) {
  if (frame.size != can::Frame::kMostData || frame.data[0] != set_byte(number)) return std::nullopt;
  std::uint64_t bits = 0;
  for (std::size_t byte = 1; byte < frame.size; ++byte) bits = bits << 8 | frame.data[byte];
  Torques torques;
  for (std::size_t slot = kTorquesPerFrame; slot-- > 0; bits >>= kTorqueBits) {
    torques[slot] =
        static_cast<std::int16_t>(sign_extended(static_cast<std::uint32_t>(bits), kTorqueBits));
  }
  return torques;
}

}  // namespace armature::wam
