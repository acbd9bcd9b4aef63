// SPDX-License-Identifier: Apache-2.0
// The services of CANopen one by one, without a bus.
#include <chrono>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drives/canopen/emergency.hpp"
#include "drives/canopen/heartbeat.hpp"
#include "drives/canopen/little_endian.hpp"
#include "drives/canopen/nmt.hpp"
#include "drives/canopen/pdo.hpp"
#include "drives/canopen/sdo_client.hpp"
#include "drives/canopen/sdo_server.hpp"
#include "drives/canopen/sync.hpp"

namespace armature::canopen {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;

base::Time at(base::Duration since_begin) { return base::Time{} + since_begin; }

TEST(CobIds, EachServiceHasItsIdentifiers) {
  const auto origin = [](std::uint32_t id) { return origin_of(can::data_frame(id, {})); };
  EXPECT_EQ(origin(0x000), (Origin{Service::kNmt}));
  EXPECT_EQ(origin(0x080), (Origin{Service::kSync}));
  EXPECT_EQ(origin(0x081), (Origin{Service::kEmergency, 1}));
  EXPECT_EQ(origin(0x100), (Origin{Service::kTime}));
  for (std::uint8_t pdo = 1; pdo <= 4; ++pdo) {
    EXPECT_EQ(origin(cob_id::transmit_pdo(pdo, 127)), (Origin{Service::kTransmitPdo, 127, pdo}));
    EXPECT_EQ(origin(cob_id::receive_pdo(pdo, 3)), (Origin{Service::kReceivePdo, 3, pdo}));
  }
  EXPECT_EQ(cob_id::transmit_pdo(1, 1), 0x181u);
  EXPECT_EQ(cob_id::receive_pdo(4, 1), 0x501u);
  EXPECT_EQ(origin(0x5ff), (Origin{Service::kSdoResponse, 127}));
  EXPECT_EQ(origin(0x601), (Origin{Service::kSdoRequest, 1}));
  EXPECT_EQ(origin(0x701), (Origin{Service::kHeartbeat, 1}));
  for (std::uint32_t id : {0x101u, 0x180u, 0x580u, 0x680u, 0x7ffu}) {
    EXPECT_EQ(origin(id), Origin{}) << id;
  }
  EXPECT_EQ(origin_of(can::extended_frame(0x181, {})), Origin{});
  EXPECT_EQ(origin_of(can::remote_frame(0x701, 1)), Origin{});
}

TEST(Numbers, AreLittleEndianAndHaveTheirSign) {
  EXPECT_EQ(load(std::vector<std::uint8_t>{0x78, 0x56, 0x34, 0x12}), 0x12345678u);
  EXPECT_EQ(sign_extended(0xff, 8), -1);
  EXPECT_EQ(sign_extended(0x7f, 8), 127);
  EXPECT_EQ(sign_extended(~std::uint64_t{0}, 64), -1);
}

TEST(Nmt, ACommandIsForItsNodeOrForAll) {
  EXPECT_EQ(nmt_frame(NmtCommand::kStart, 7), can::data_frame(0, {1, 7}));
  EXPECT_EQ(parse_nmt(nmt_frame(NmtCommand::kStop, 7), 7), NmtCommand::kStop);
  EXPECT_EQ(parse_nmt(nmt_frame(NmtCommand::kStop, kEveryNode), 7), NmtCommand::kStop);
  EXPECT_FALSE(parse_nmt(nmt_frame(NmtCommand::kStop, 8), 7));
  EXPECT_FALSE(parse_nmt(can::data_frame(0, {1}), 7));
  EXPECT_FALSE(parse_nmt(can::data_frame(0, {3, 7}), 7));
}

TEST(Nmt, ASlaveFollows) {
  NmtSlave slave;
  slave.booted();
  EXPECT_EQ(slave.take(NmtCommand::kStart), NmtSlave::Reset::kNone);
  EXPECT_EQ(slave.state(), NmtState::kOperational);
  EXPECT_EQ(slave.take(NmtCommand::kResetNode), NmtSlave::Reset::kNode);
  EXPECT_EQ(slave.state(), NmtState::kBootUp);
}

TEST(Heartbeats, ANodeIsLostOnlyAfterItWasThere) {
  HeartbeatConsumer consumer;
  consumer.watch(3, 10ms);
  consumer.check(at(1s));
  EXPECT_EQ(consumer.node(3).presence, Presence::kAwaited);
  consumer.take(heartbeat_frame(3, NmtState::kOperational), at(1s));
  consumer.check(at(1s + 10ms));
  EXPECT_EQ(consumer.node(3).presence, Presence::kPresent);
  EXPECT_EQ(consumer.node(3).state, NmtState::kOperational);
  consumer.check(at(1s + 10ms + 1ns));
  EXPECT_EQ(consumer.node(3).presence, Presence::kLost);
  consumer.take(heartbeat_frame(3, NmtState::kBootUp), at(2s));
  EXPECT_EQ(consumer.node(3).presence, Presence::kPresent);
  EXPECT_EQ(consumer.node(3).boot_ups, 1u);
}

TEST(Heartbeats, OfOthersAndAnswersOfNodeGuardingDoNotCount) {
  HeartbeatConsumer consumer;
  consumer.watch(3, 10ms);
  consumer.take(heartbeat_frame(4, NmtState::kOperational), at(1s));
  consumer.take(can::data_frame(0x703, {0x85}), at(1s));
  consumer.take(can::data_frame(0x703, {}), at(1s));
  EXPECT_EQ(consumer.node(3).presence, Presence::kAwaited);
  EXPECT_EQ(consumer.node(4).presence, Presence::kAwaited);
}

TEST(Sync, CountsToItsOverflow) {
  SyncProducer producer(3);
  std::vector<int> counters;
  for (int i = 0; i < 5; ++i) counters.push_back(producer.step().data[0]);
  EXPECT_THAT(counters, ElementsAre(1, 2, 3, 1, 2));
  EXPECT_EQ(SyncProducer().step(), can::data_frame(0x80, {}));
}

TEST(Sync, AConsumerSeesSkipsAndSilence) {
  SyncConsumer consumer(3);
  consumer.set_timeout(5ms);
  EXPECT_FALSE(consumer.missing(at(1s))) << "it never came";
  EXPECT_EQ(consumer.take(can::data_frame(0x80, {1}), at(1s)), SyncConsumer::Heard::kSync);
  EXPECT_EQ(consumer.take(can::data_frame(0x80, {3}), at(1s)), SyncConsumer::Heard::kSync);
  EXPECT_EQ(consumer.skips(), 1u);
  EXPECT_EQ(consumer.take(can::data_frame(0x80, {}), at(1s)), SyncConsumer::Heard::kWrongLength);
  EXPECT_FALSE(consumer.missing(at(1s + 5ms)));
  EXPECT_TRUE(consumer.missing(at(1s + 5ms + 1ns)));
}

TEST(Emergencies, AreReadAsTheyAreWritten) {
  const Emergency emergency{.node = 3, .code = 0x2310, .error_register = 3, .manufacturer = {1, 2}};
  EXPECT_EQ(emergency_frame(emergency), can::data_frame(0x83, {0x10, 0x23, 3, 1, 2, 0, 0, 0}));
  EXPECT_EQ(parse_emergency(emergency_frame(emergency)), emergency);
  EXPECT_FALSE(parse_emergency(can::data_frame(0x83, {1, 2, 3})));
  EXPECT_EQ(to_text(emergency),
            "node 3 reports 0x2310, overcurrent at the output (error register 0x03)");
  EXPECT_STREQ(meaning_of_emergency(0x2399), "current at the output of the device");
  EXPECT_STREQ(meaning_of_emergency(0xff12), "specific to the device, see its manual");
}

TEST(Pdos, BitsAndBytesArePackedFromTheLowestBit) {
  const Pdo pdo{
      .cob_id = 0x181,
      .valid = true,
      .objects = {{{0x2000, 0}, 1}, {{0x2001, 0}, 3}, {{0x2002, 0}, 12}, {{0x2003, 0}, 32}}};
  const std::vector<std::uint64_t> values{1, 5, 0xabc, 0x12345678};
  const can::Frame frame = pack(pdo, values);
  EXPECT_EQ(frame, can::data_frame(0x181, {0xcb, 0xab, 0x78, 0x56, 0x34, 0x12}));
  std::vector<std::uint64_t> read(4);
  ASSERT_TRUE(unpack(pdo, frame, read));
  EXPECT_EQ(read, values);
}

TEST(Pdos, AValueThatIsTooWideIsCut) {
  const Pdo pdo{.cob_id = 0x181, .valid = true, .objects = {{{0x2000, 0}, 8}, {{0x2001, 0}, 8}}};
  EXPECT_EQ(pack(pdo, std::vector<std::uint64_t>{0x1ff, 1}), can::data_frame(0x181, {0xff, 1}));
}

TEST(Pdos, AShortFrameOrAnotherOneIsNotRead) {
  const Pdo pdo{.cob_id = 0x181, .valid = true, .objects = {{{0x2000, 0}, 16}}};
  std::vector<std::uint64_t> values{7};
  EXPECT_FALSE(unpack(pdo, can::data_frame(0x181, {1}), values));
  EXPECT_FALSE(unpack(pdo, can::data_frame(0x182, {1, 2}), values));
  EXPECT_FALSE(unpack(pdo, can::remote_frame(0x181, 8), values));
  EXPECT_EQ(values[0], 7u);
  EXPECT_TRUE(unpack(pdo, can::data_frame(0x181, {1, 2, 3}), values));
  EXPECT_EQ(values[0], 0x201u);
}

TEST(Pdos, WhatDoesNotFitIsRefused) {
  EXPECT_FALSE(check_mapping(std::vector<MappedObject>(3, {{0x2000, 0}, 32})));
  EXPECT_FALSE(check_mapping(std::vector<MappedObject>(1, {{0x2000, 0}, 0})));
  EXPECT_TRUE(check_mapping(std::vector<MappedObject>(2, {{0x2000, 0}, 32})));
}

TEST(Pdos, AreSentAtChangesAndAtLeastAtTheirEventTimer) {
  PdoTimer timer(Pdo{.inhibit_100us = 20, .event_ms = 10, .objects = {}});
  EXPECT_TRUE(timer.step(true, at(0ms)));
  EXPECT_FALSE(timer.step(true, at(1ms))) << "inhibited";
  EXPECT_TRUE(timer.step(true, at(2ms)));
  EXPECT_FALSE(timer.step(false, at(11ms)));
  EXPECT_TRUE(timer.step(false, at(12ms)));
}

/// A client that has sent what begins a transfer.
struct Asked {
  SdoClient client{3};
  can::Frame request = client.begin_upload({0x2000, 1}, base::Time{});
};

TEST(SdoClient, AsksAsCia301HasIt) {
  Asked asked;
  EXPECT_EQ(asked.request, can::data_frame(0x603, {0x40, 0x00, 0x20, 1, 0, 0, 0, 0}));
  EXPECT_FALSE(asked.client.take(can::data_frame(0x583, {0x4b, 0x00, 0x20, 1, 7, 1, 9, 9}), {}));
  EXPECT_EQ(asked.client.status(), SdoClient::Status::kDone);
  EXPECT_THAT(asked.client.bytes(), ElementsAre(7, 1));
}

TEST(SdoClient, AnAnswerForAnotherObjectIsNotTaken) {
  Asked asked;
  EXPECT_FALSE(asked.client.take(can::data_frame(0x583, {0x4b, 0x01, 0x20, 1, 7, 1, 0, 0}), {}));
  EXPECT_EQ(asked.client.status(), SdoClient::Status::kBusy);
}

TEST(SdoClient, AToggleBitThatDoesNotAlternateIsAnAbort) {
  Asked asked;
  ASSERT_TRUE(asked.client.take(can::data_frame(0x583, {0x41, 0, 0x20, 1, 9, 0, 0, 0}), {}));
  const auto abort = asked.client.take(can::data_frame(0x583, {0x10, 1, 2, 3, 4, 5, 6, 7}), {});
  ASSERT_TRUE(abort);
  EXPECT_EQ(*abort, can::data_frame(0x603, {0x80, 0, 0x20, 1, 0, 0, 3, 5}));
  EXPECT_EQ(asked.client.abort_code(), AbortCode::kToggleBit);
}

TEST(SdoClient, FewerBytesThanAnnouncedAreAnAbort) {
  Asked asked;
  ASSERT_TRUE(asked.client.take(can::data_frame(0x583, {0x41, 0, 0x20, 1, 9, 0, 0, 0}), {}));
  ASSERT_TRUE(asked.client.take(can::data_frame(0x583, {0x01, 1, 2, 3, 4, 5, 6, 7}), {}));
  EXPECT_EQ(asked.client.abort_code(), AbortCode::kWrongLength);
}

TEST(SdoClient, AnAnnouncementBeyondItsMemoryIsAnAbort) {
  Asked asked;
  ASSERT_TRUE(
      asked.client.take(can::data_frame(0x583, {0x41, 0, 0x20, 1, 0xff, 0xff, 0xff, 0xff}), {}));
  EXPECT_EQ(asked.client.abort_code(), AbortCode::kOutOfMemory);
}

TEST(SdoServer, RefusesBlockTransfersAndUnknownCommands) {
  ObjectDictionary dictionary;
  SdoServer server(3, dictionary);
  for (const std::uint8_t command : std::vector<std::uint8_t>{0xa0, 0xc0, 0xe0}) {
    const auto answer = server.take(can::data_frame(0x603, {command, 0, 0x20, 1, 0, 0, 0, 0}), {});
    ASSERT_TRUE(answer);
    EXPECT_EQ(*answer, can::data_frame(0x583, {0x80, 0, 0x20, 1, 1, 0, 4, 5})) << int{command};
  }
}

TEST(SdoServer, GivesUpAClientThatFallsSilent) {
  ObjectDictionary dictionary;
  dictionary.add_bytes({.address = {0x2000, 1}, .name = "Program", .type = DataType::kDomain}, {});
  SdoServer server(3, dictionary);
  ASSERT_TRUE(server.take(can::data_frame(0x603, {0x21, 0, 0x20, 1, 9, 0, 0, 0}), at(1s)));
  EXPECT_FALSE(server.check(at(2s)));
  EXPECT_EQ(server.check(at(2s + 1ns)), can::data_frame(0x583, {0x80, 0, 0x20, 1, 0, 0, 4, 5}));
  EXPECT_FALSE(server.check(at(9s)));
}

}  // namespace
}  // namespace armature::canopen
