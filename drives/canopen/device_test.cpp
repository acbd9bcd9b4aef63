// SPDX-License-Identifier: Apache-2.0
#include "drives/canopen/device.hpp"

#include <chrono>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drives/canopen/sdo_channel.hpp"
#include "drives/canopen/test_link.hpp"

namespace armature::canopen {
namespace {

using namespace std::chrono_literals;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr NodeId kNode = 5;
constexpr Address kOutput{0x2000, 0};
constexpr Address kInput{0x2001, 0};
constexpr Address kText{0x2002, 0};

/// A device with two numbers and a text, and its host.
class DeviceOnABus : public ::testing::Test {
 protected:
  DeviceOnABus() {
    ObjectDictionary& dictionary = device_.dictionary();
    dictionary.add({.address = kOutput,
                    .name = "Output",
                    .type = DataType::kInteger16,
                    .mappable = true,
                    .low = -100,
                    .high = 100});
    dictionary.add({.address = kInput,
                    .name = "Input",
                    .type = DataType::kUnsigned32,
                    .access = Access::kReadOnly,
                    .mappable = true});
    dictionary.add_bytes({.address = kText, .name = "Text", .type = DataType::kVisibleString}, {});
    link_.add_party([this](base::Time now) {
      can::Arrival arrival;
      while (station_.receive(arrival) == can::ReceiveStatus::kReceived) device_.take(arrival);
      device_.step(now);
    });
    device_.boot(link_.now());
    link_.advance(1ms);
  }
  void tell(NmtCommand command) {
    link_.bus().send(nmt_frame(command, kNode));
    link_.advance(1ms);
  }
  void send_and_wait(const can::Frame& frame) {
    link_.bus().send(frame);
    link_.advance(1ms);
  }

  TestLink link_;
  can::VirtualStation& station_ = link_.station();
  Device device_{{.node = kNode,
                  .device_type = 0x00020192,
                  .identity = {.vendor = 1, .product = 2, .revision = 3, .serial = 4},
                  .name = "a device with a long name"},
                 station_};
  SdoChannel channel_{link_, kNode};
};

TEST_F(DeviceOnABus, SaysThatItHasStarted) {
  EXPECT_THAT(link_.received(), ElementsAre(can::data_frame(0x705, {0})));
  EXPECT_EQ(device_.state(), NmtState::kPreOperational);
}

TEST_F(DeviceOnABus, ShowsItsIdentity) {
  EXPECT_EQ(channel_.read({0x1000, 0}, DataType::kUnsigned32).value(), 0x00020192);
  EXPECT_EQ(channel_.read({0x1018, 4}, DataType::kUnsigned32).value(), 4);
}

TEST_F(DeviceOnABus, GivesALongTextInSegments) {
  const auto bytes = channel_.upload({0x1008, 0});
  ASSERT_TRUE(bytes) << bytes.error();
  EXPECT_EQ(std::string(bytes.value().begin(), bytes.value().end()), "a device with a long name");
}

TEST_F(DeviceOnABus, TakesTextsOfEachLength) {
  for (std::size_t size : {0u, 1u, 4u, 5u, 7u, 8u, 14u, 15u, 1000u}) {
    const std::vector<std::uint8_t> text(size, 'x');
    const auto written = channel_.download(kText, text);
    ASSERT_TRUE(written) << size << ": " << written.error();
    const auto read = channel_.upload(kText);
    ASSERT_TRUE(read) << size << ": " << read.error();
    EXPECT_EQ(read.value(), text);
  }
}

TEST_F(DeviceOnABus, RefusesWhatTheDictionaryDoesNotAllow) {
  EXPECT_THAT(channel_.read({0x3000, 0}, DataType::kUnsigned8).error(),
              HasSubstr("node 5 does not let 0x3000:00 be read: 0x06020000, no such object"));
  EXPECT_THAT(channel_.read({0x1018, 9}, DataType::kUnsigned8).error(), HasSubstr("subindex"));
  EXPECT_THAT(channel_.write(kInput, DataType::kUnsigned32, 1).error(), HasSubstr("0x06010002"));
  EXPECT_THAT(channel_.write(kOutput, DataType::kInteger32, 1).error(), HasSubstr("0x06070012"));
  EXPECT_THAT(channel_.write(kOutput, DataType::kInteger8, 1).error(), HasSubstr("0x06070013"));
  EXPECT_THAT(channel_.write(kOutput, DataType::kInteger16, 101).error(), HasSubstr("too high"));
  EXPECT_THAT(channel_.write(kOutput, DataType::kInteger16, -101).error(), HasSubstr("too low"));
  EXPECT_TRUE(channel_.write(kOutput, DataType::kInteger16, -100));
  EXPECT_EQ(channel_.read(kOutput, DataType::kInteger16).value(), -100);
}

TEST_F(DeviceOnABus, TellsWhenTheTypeIsAnother) {
  EXPECT_THAT(channel_.read(kOutput, DataType::kInteger32).error(),
              HasSubstr("has 2 bytes in 0x2000:00, expected INTEGER32"));
}

TEST_F(DeviceOnABus, ASilentDeviceIsATimeout) {
  SdoChannel other(link_, 9);
  EXPECT_THAT(other.read({0x1000, 0}, DataType::kUnsigned32).error(),
              HasSubstr("node 9 does not let 0x1000:00 be read: 0x05040000"));
}

TEST_F(DeviceOnABus, AnswersNoSdoWhenStopped) {
  tell(NmtCommand::kStop);
  EXPECT_FALSE(channel_.read({0x1000, 0}, DataType::kUnsigned32));
  tell(NmtCommand::kEnterPreOperational);
  EXPECT_TRUE(channel_.read({0x1000, 0}, DataType::kUnsigned32));
}

TEST_F(DeviceOnABus, SendsHeartbeatsAsOftenAsItIsTold) {
  ASSERT_TRUE(channel_.write({0x1017, 0}, DataType::kUnsigned16, 10));
  link_.received();
  link_.advance(100ms);
  const auto frames = link_.received();
  EXPECT_EQ(frames.size(), 10u);
  EXPECT_THAT(frames, Contains(can::data_frame(0x705, {0x7f})));
}

TEST_F(DeviceOnABus, ReadingParametersDoesNotDelayItsHeartbeat) {
  ASSERT_TRUE(channel_.write({0x1017, 0}, DataType::kUnsigned16, 10));
  link_.received();
  for (int i = 0; i < 20; ++i) {
    ASSERT_TRUE(channel_.read({0x1001, 0}, DataType::kUnsigned8));
    link_.advance(4ms);
  }
  link_.bus().send(nmt_frame(NmtCommand::kStart, 99));
  link_.advance(30ms);
  EXPECT_THAT(link_.received(), Contains(can::data_frame(0x705, {0x7f})));
}

/// Its output by RPDO1 and its input by TPDO1.
class DeviceWithPdos : public DeviceOnABus {
 protected:
  void map(std::uint8_t transmission) {
    receive_.transmission = transmission;
    transmit_.transmission = transmission;
    const auto written = write_pdo(channel_, PdoDirection::kReceive, 1, receive_);
    ASSERT_TRUE(written) << written.error();
    const auto again = write_pdo(channel_, PdoDirection::kTransmit, 1, transmit_);
    ASSERT_TRUE(again) << again.error();
  }

  Pdo receive_{.cob_id = cob_id::receive_pdo(1, kNode), .valid = true, .objects = {{kOutput, 16}}};
  Pdo transmit_{.cob_id = cob_id::transmit_pdo(1, kNode), .valid = true, .objects = {{kInput, 32}}};
};

TEST_F(DeviceWithPdos, WhatIsWrittenIsReadAgain) {
  transmit_.inhibit_100us = 20;
  transmit_.event_ms = 50;
  map(transmission::kProfilesEvent);
  EXPECT_EQ(read_pdo(channel_, PdoDirection::kReceive, 1).value(), receive_);
  EXPECT_EQ(read_pdo(channel_, PdoDirection::kTransmit, 1).value(), transmit_);
}

TEST_F(DeviceWithPdos, AnswersEachSync) {
  map(transmission::kAtEverySync);
  device_.dictionary().set_number(kInput, 0x01020304);
  tell(NmtCommand::kStart);
  link_.received();
  link_.bus().send(pack(receive_, std::vector<std::uint64_t>{0xfffe}));
  link_.advance(1ms);
  EXPECT_EQ(device_.dictionary().number(kOutput), 0) << "it waits for SYNC";
  send_and_wait(SyncProducer().step());
  EXPECT_EQ(device_.dictionary().number(kOutput), -2);
  EXPECT_THAT(link_.received(), ElementsAre(can::data_frame(0x185, {4, 3, 2, 1})));
}

TEST_F(DeviceWithPdos, SendsNothingBeforeItIsStarted) {
  map(transmission::kAtEverySync);
  link_.received();
  send_and_wait(SyncProducer().step());
  EXPECT_TRUE(link_.received().empty());
}

TEST_F(DeviceWithPdos, SendsAtChangesNoOftenerThanTheInhibitTime) {
  transmit_.inhibit_100us = 100;
  map(transmission::kProfilesEvent);
  tell(NmtCommand::kStart);
  link_.received();
  for (int i = 1; i <= 100; ++i) {
    device_.dictionary().set_number(kInput, i);
    link_.advance(1ms);
  }
  EXPECT_EQ(link_.received().size(), 10u);
}

TEST_F(DeviceWithPdos, AShortPdoIsReportedAndNotUsed) {
  map(transmission::kProfilesEvent);
  tell(NmtCommand::kStart);
  link_.received();
  send_and_wait(can::data_frame(receive_.cob_id, {1}));
  EXPECT_EQ(device_.dictionary().number(kOutput), 0);
  EXPECT_THAT(link_.received(),
              Contains(can::data_frame(0x085, {0x10, 0x82, 0x11, 0, 0, 0, 0, 0})));
}

TEST_F(DeviceWithPdos, AFixedMappingIsTakenIfItIsTheWantedOne) {
  map(transmission::kAtEverySync);
  for (std::uint8_t sub : {std::uint8_t{0}, std::uint8_t{1}}) {
    device_.dictionary().find({0x1600, sub})->info.access = Access::kConstant;
  }
  EXPECT_TRUE(write_pdo(channel_, PdoDirection::kReceive, 1, receive_));
  receive_.objects.clear();
  EXPECT_THAT(write_pdo(channel_, PdoDirection::kReceive, 1, receive_).error(),
              HasSubstr("node 5 does not let 0x1600:00 be written: 0x06010002"));
}

TEST_F(DeviceWithPdos, AnswersASyncWithACounterAndAnotherIdentifier) {
  map(transmission::kAtEverySync);
  ASSERT_TRUE(channel_.write({0x1005, 0}, DataType::kUnsigned32, 0x90));
  ASSERT_TRUE(channel_.write({0x1019, 0}, DataType::kUnsigned8, 10));
  tell(NmtCommand::kStart);
  link_.received();
  send_and_wait(SyncProducer().step());
  EXPECT_TRUE(link_.received().empty());
  send_and_wait(SyncProducer(10, 0x90).step());
  EXPECT_THAT(link_.received(), ElementsAre(can::data_frame(0x185, {0, 0, 0, 0})));
  send_and_wait(can::data_frame(0x90, {}));
  EXPECT_THAT(link_.received(), Contains(can::data_frame(0x085, {0x40, 0x82, 0x11, 0, 0, 0, 0, 0})))
      << "SYNC has an unexpected length";
}

TEST_F(DeviceOnABus, ItsErrorsCanBeClearedAndNothingElse) {
  device_.report(0x1234, 0);
  EXPECT_EQ(channel_.read({0x1003, 1}, DataType::kUnsigned32).value(), 0x1234);
  EXPECT_FALSE(channel_.write({0x1003, 0}, DataType::kUnsigned8, 3));
  EXPECT_TRUE(channel_.write({0x1003, 0}, DataType::kUnsigned8, 0));
  EXPECT_EQ(channel_.read({0x1003, 0}, DataType::kUnsigned8).value(), 0);
}

TEST_F(DeviceWithPdos, RefusesMappingsThatCannotBe) {
  map(transmission::kAtEverySync);
  EXPECT_THAT(channel_.write({0x1600, 1}, DataType::kUnsigned32, 0x20000010).error(),
              HasSubstr("0x06010000"))
      << "it is in use";
  ASSERT_TRUE(channel_.write({0x1600, 0}, DataType::kUnsigned8, 0));
  EXPECT_THAT(channel_.write({0x1600, 1}, DataType::kUnsigned32, 0x30000010).error(),
              HasSubstr("no such object"));
  EXPECT_THAT(channel_.write({0x1600, 1}, DataType::kUnsigned32, 0x20010020).error(),
              HasSubstr("cannot be mapped"))
      << "it can only be read";
  EXPECT_THAT(channel_.write({0x1600, 1}, DataType::kUnsigned32, 0x20000008).error(),
              HasSubstr("cannot be mapped"))
      << "it has 16 bits";
}

TEST_F(DeviceWithPdos, AResetOfTheNodeBringsBackWhatItHadAtPowerOn) {
  map(transmission::kAtEverySync);
  ASSERT_TRUE(channel_.write(kOutput, DataType::kInteger16, 7));
  link_.received();
  tell(NmtCommand::kResetNode);
  EXPECT_THAT(link_.received(), ElementsAre(can::data_frame(0x705, {0})));
  EXPECT_EQ(device_.dictionary().number(kOutput), 0);
  EXPECT_FALSE(read_pdo(channel_, PdoDirection::kReceive, 1).value().valid);
}

TEST_F(DeviceWithPdos, AResetOfCommunicationLeavesTheProfileAlone) {
  map(transmission::kAtEverySync);
  ASSERT_TRUE(channel_.write(kOutput, DataType::kInteger16, 7));
  tell(NmtCommand::kResetCommunication);
  EXPECT_EQ(device_.dictionary().number(kOutput), 7);
  EXPECT_FALSE(read_pdo(channel_, PdoDirection::kReceive, 1).value().valid);
}

TEST_F(DeviceOnABus, KnowsThatItsMasterIsGone) {
  ASSERT_TRUE(channel_.write({0x1016, 1}, DataType::kUnsigned32, 0x00010000 | 20));
  link_.advance(100ms);
  EXPECT_FALSE(device_.lost_node()) << "it was never there";
  send_and_wait(heartbeat_frame(1, NmtState::kOperational));
  link_.advance(15ms);
  EXPECT_FALSE(device_.lost_node());
  link_.advance(10ms);
  EXPECT_EQ(device_.lost_node(), NodeId{1});
}

}  // namespace
}  // namespace armature::canopen
