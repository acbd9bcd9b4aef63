// SPDX-License-Identifier: Apache-2.0
// The cyclic part of CANopen: PDO, SYNC, heartbeats, NMT, EMCY, values of a dictionary.
#include <array>
#include <chrono>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "drives/canopen/emergency.hpp"
#include "drives/canopen/heartbeat.hpp"
#include "drives/canopen/nmt.hpp"
#include "drives/canopen/object_dictionary.hpp"
#include "drives/canopen/pdo.hpp"
#include "drives/canopen/sync.hpp"
#include "tests/realtime/expect_realtime.hpp"

namespace armature::canopen {
namespace {

using namespace std::chrono_literals;

constexpr base::Time kNow{1s};

TEST(RealtimeCanopen, Frames) {
  can::Frame frame = can::data_frame(0x181, {1});
  Origin origin;
  expect_realtime("canopen::origin_of", [&] { origin = origin_of(frame); });
  EXPECT_EQ(origin.pdo, 1);
  std::optional<NmtCommand> command;
  expect_realtime("canopen::nmt_frame", [&] { frame = nmt_frame(NmtCommand::kStart, 1); });
  expect_realtime("canopen::parse_nmt", [&] { command = parse_nmt(frame, 1); });
  EXPECT_EQ(command, NmtCommand::kStart);
  NmtSlave slave;
  expect_realtime("NmtSlave::booted", [&] { slave.booted(); });
  expect_realtime("NmtSlave::take", [&] { slave.take(NmtCommand::kStart); });
  EXPECT_EQ(slave.state(), NmtState::kOperational);
}

TEST(RealtimeCanopen, Emergencies) {
  can::Frame frame;
  std::optional<Emergency> read;
  const char* meaning = "";
  expect_realtime("canopen::emergency_frame",
                  [&] { frame = emergency_frame({.node = 3, .code = 0x2310}); });
  expect_realtime("canopen::parse_emergency", [&] { read = parse_emergency(frame); });
  expect_realtime("canopen::meaning_of_emergency", [&] { meaning = meaning_of_emergency(0x2310); });
  EXPECT_EQ(read->code, 0x2310);
  EXPECT_STREQ(meaning, "overcurrent at the output");
}

TEST(RealtimeCanopen, Heartbeats) {
  can::Frame frame;
  std::optional<NmtState> state;
  expect_realtime("canopen::heartbeat_frame",
                  [&] { frame = heartbeat_frame(3, NmtState::kOperational); });
  expect_realtime("canopen::parse_heartbeat", [&] { state = parse_heartbeat(frame); });
  EXPECT_EQ(state, NmtState::kOperational);
  HeartbeatProducer producer(3);
  base::Time now = kNow;
  std::optional<can::Frame> due;
  expect_realtime("HeartbeatProducer::set_period", [&] { producer.set_period(1ms, now); });
  expect_realtime("HeartbeatProducer::step", [&] { due = producer.step(*state, now += 1ms); });
  EXPECT_EQ(due, frame);
  HeartbeatConsumer consumer;
  consumer.watch(3, 1ms);
  expect_realtime("HeartbeatConsumer::take", [&] { consumer.take(frame, kNow); });
  expect_realtime("HeartbeatConsumer::check", [&] { consumer.check(kNow + 1s); });
  EXPECT_EQ(consumer.node(3).presence, Presence::kLost);
}

TEST(RealtimeCanopen, Pdos) {
  const Pdo pdo{.cob_id = 0x181,
                .valid = true,
                .inhibit_100us = 1,
                .objects = {{{0x6041, 0}, 16}, {{0x6064, 0}, 32}}};
  const std::array<std::uint64_t, 2> values{0x1234, 7};
  std::array<std::uint64_t, 2> read{};
  can::Frame frame;
  unsigned bits = 0;
  bool sent = false;
  expect_realtime("canopen::mapped_bits", [&] { bits = mapped_bits(pdo.objects); });
  EXPECT_EQ(bits, 48u);
  expect_realtime("canopen::pack", [&] { frame = pack(pdo, values); });
  expect_realtime("canopen::unpack", [&] { unpack(pdo, frame, read); });
  EXPECT_EQ(read, values);
  PdoTimer timer(pdo);
  base::Time now = kNow;
  expect_realtime("PdoTimer::step", [&] { sent = timer.step(true, now += 1ms); });
  EXPECT_TRUE(sent);
}

TEST(RealtimeCanopen, Sync) {
  SyncProducer producer(10);
  SyncConsumer consumer(10);
  can::Frame frame;
  bool missing = false;
  expect_realtime("SyncProducer::step", [&] { frame = producer.step(); });
  EXPECT_EQ(frame.size, 1);
  expect_realtime("SyncConsumer::set_timeout", [&] { consumer.set_timeout(1ms); });
  expect_realtime("SyncConsumer::take", [&] { consumer.take(frame, kNow); });
  expect_realtime("SyncConsumer::missing", [&] { missing = consumer.missing(kNow + 1s); });
  EXPECT_TRUE(missing);
  expect_realtime("SyncConsumer::forget", [&] { consumer.forget(); });
  EXPECT_FALSE(consumer.missing(kNow + 1s));
}

TEST(RealtimeCanopen, ValuesOfADictionary) {
  ObjectDictionary dictionary;
  dictionary.add({.address = {0x6064, 0}, .name = "Position", .type = DataType::kInteger32});
  std::int64_t number = 0;
  expect_realtime("ObjectDictionary::set_number", [&] { dictionary.set_number({0x6064, 0}, -5); });
  expect_realtime("ObjectDictionary::number", [&] { number = dictionary.number({0x6064, 0}); });
  EXPECT_EQ(number, -5);
  const ObjectDictionary::Entry* entry = nullptr;
  expect_realtime("ObjectDictionary::find", [&] { entry = dictionary.find({0x6064, 0}); });
  EXPECT_NE(entry, nullptr);
}

}  // namespace
}  // namespace armature::canopen
