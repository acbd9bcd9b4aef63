// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/base/diagnostic.hpp"
#include "armature/can/bus.hpp"

// What every implementation of Bus has to do. An implementation runs it with a rig of its own:
//
//   INSTANTIATE_TEST_SUITE_P(Virtual, BusConformance, testing::Values(BusImplementation{...}));

namespace armature::can::internal {

/// Two stations on one bus, closed, and nobody else there.
class BusRig {
 public:
  virtual ~BusRig() = default;
  virtual Bus& first() = 0;
  virtual Bus& second() = 0;
  /// Returns when everything that was sent has come in.
  virtual void settle() = 0;
  /// Waits for what another thread of the implementation does; false if it does not.
  virtual bool wait_for(const std::function<bool()>& condition) { return condition(); }
  /// Drives the first station bus-off; false if the implementation cannot.
  virtual bool force_bus_off() { return false; }
  /// Brings it back, by `Bus::restart` if that can.
  virtual void restart() { EXPECT_EQ(first().restart(), RestartStatus::kRestarting); }
  /// False for a controller that cannot receive a remote frame that asks for data.
  virtual bool receives_remote_frames_for_data() const { return true; }
};

struct BusImplementation {
  std::string name;
  std::function<std::unique_ptr<BusRig>()> make_rig;

  friend void PrintTo(const BusImplementation& implementation, std::ostream* out) {
    *out << implementation.name;
  }
};

class BusConformance : public testing::TestWithParam<BusImplementation> {
 protected:
  Bus& first() { return rig_->first(); }
  Bus& second() { return rig_->second(); }

  static void open(Bus& bus, const BusOptions& options = {}) {
    base::Diagnostics diagnostics;
    ASSERT_TRUE(bus.open(options, diagnostics)) << diagnostics.to_text();
  }
  void open_both() {
    open(first());
    open(second());
  }
  /// All that has come in, as text.
  static std::vector<std::string> received(Bus& bus) {
    std::vector<std::string> all;
    Arrival arrival;
    while (bus.receive(arrival) == ReceiveStatus::kReceived) {
      all.emplace_back(to_text(arrival.frame).view());
    }
    return all;
  }
  /// The first station's state; some implementations learn it when they receive.
  BusState state_when_read() {
    received(first());
    return first().state();
  }
  void send(Bus& bus, const Frame& frame) {
    ASSERT_EQ(bus.send(frame), SendStatus::kSent) << to_text(frame).view();
    rig_->settle();
  }

  const std::unique_ptr<BusRig> rig_ = GetParam().make_rig();
};

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(BusConformance);

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST_P(BusConformance, AClosedBusNeitherSendsNorReceivesAndSaysSo) {
  EXPECT_EQ(first().state(), BusState::kClosed);
  EXPECT_EQ(first().send(data_frame(1, {})), SendStatus::kDown);
  Arrival arrival;
  EXPECT_EQ(first().receive(arrival), ReceiveStatus::kDown);
  EXPECT_EQ(first().counters().refused, 1u);
  first().close();
}

TEST_P(BusConformance, EveryKindOfFrameArrivesAsItWasSent) {
  open_both();
  send(first(), data_frame(0x123, {0xde, 0xad}));
  send(first(), data_frame(0x7ff, {}));
  send(first(), extended_frame(0x1fffffff, {1, 2, 3, 4, 5, 6, 7, 8}));
  send(first(), extended_frame(0x123, {9}));
  send(first(), remote_frame(0x123, 0));
  EXPECT_THAT(received(second()),
              ElementsAre("123#DEAD", "7FF#", "1FFFFFFF#0102030405060708", "00000123#09", "123#R"));
  EXPECT_EQ(first().counters().sent, 5u);
  EXPECT_EQ(second().counters().received, 5u);
}

TEST_P(BusConformance, ARemoteFrameTellsHowMuchItAsksFor) {
  if (!rig_->receives_remote_frames_for_data()) GTEST_SKIP() << "cannot receive it";
  open_both();
  send(first(), remote_frame(0x123, 4));
  EXPECT_THAT(received(second()), ElementsAre("123#R4"));
}

TEST_P(BusConformance, BothWaysAtOnce) {
  open_both();
  send(first(), data_frame(1, {1}));
  send(second(), data_frame(2, {2}));
  EXPECT_THAT(received(first()), ElementsAre("002#02"));
  EXPECT_THAT(received(second()), ElementsAre("001#01"));
}

TEST_P(BusConformance, FramesOfOneIdentifierKeepTheirOrder) {
  open_both();
  std::vector<std::string> expected;
  for (std::uint8_t i = 0; i < 50; ++i) {
    const Frame frame = data_frame(0x181, {i});
    ASSERT_EQ(first().send(frame), SendStatus::kSent);
    expected.emplace_back(to_text(frame).view());
  }
  rig_->settle();
  EXPECT_EQ(received(second()), expected);
}

TEST_P(BusConformance, TimesOfArrivalNeverGoBack) {
  open_both();
  for (int i = 0; i < 10; ++i) send(first(), data_frame(5, {}));
  Arrival arrival;
  base::Time last{};
  for (int i = 0; i < 10; ++i) {
    ASSERT_EQ(second().receive(arrival), ReceiveStatus::kReceived);
    EXPECT_GE(arrival.time, last);
    EXPECT_FALSE(arrival.own);
    last = arrival.time;
  }
  EXPECT_GT(last, base::Time{});
}

TEST_P(BusConformance, NothingToReceiveLeavesTheArrivalAlone) {
  open_both();
  Arrival arrival{data_frame(7, {7}), base::time_from_ns(7), true};
  EXPECT_EQ(second().receive(arrival), ReceiveStatus::kNothing);
  EXPECT_EQ(arrival.frame, data_frame(7, {7}));
  EXPECT_EQ(arrival.time, base::time_from_ns(7));
}

TEST_P(BusConformance, FiltersLetThroughWhatAnyOfThemDoes) {
  open(first());
  BusOptions options;
  options.filters = {{0x180, 0x780, false}, {0x181, Frame::kMostExtended, true}};
  open(second(), options);
  send(first(), data_frame(0x1ff, {}));
  send(first(), data_frame(0x200, {}));
  send(first(), extended_frame(0x181, {}));
  send(first(), extended_frame(0x182, {}));
  EXPECT_THAT(received(second()), ElementsAre("1FF#", "00000181#"));
  EXPECT_EQ(second().counters().lost, 0u) << "what is not wanted is not lost";
}

TEST_P(BusConformance, OwnFramesComeBackOnlyIfAskedFor) {
  BusOptions options;
  options.own_frames = true;
  open(first(), options);
  open(second());
  send(first(), data_frame(1, {}));
  Arrival arrival;
  ASSERT_EQ(first().receive(arrival), ReceiveStatus::kReceived);
  EXPECT_TRUE(arrival.own);
  send(second(), data_frame(2, {}));
  EXPECT_THAT(received(second()), ElementsAre("001#")) << "its own is not there";
  ASSERT_EQ(first().receive(arrival), ReceiveStatus::kReceived);
  EXPECT_FALSE(arrival.own);
}

TEST_P(BusConformance, WhatNoControllerCanSendIsRefused) {
  open_both();
  EXPECT_EQ(first().send(data_frame(0x800, {})), SendStatus::kInvalid);
  EXPECT_EQ(first().send(remote_frame(1, 9)), SendStatus::kInvalid);
  rig_->settle();
  EXPECT_THAT(received(second()), IsEmpty());
  EXPECT_EQ(first().counters().refused, 2u);
}

TEST_P(BusConformance, ArrivalsAreAnnounced) {
  std::atomic<int> news = 0;
  BusOptions options;
  options.on_news = [&news] { ++news; };
  open(first());
  open(second(), options);
  send(first(), data_frame(1, {}));
  EXPECT_TRUE(rig_->wait_for([&news] { return news >= 1; }));
}

TEST_P(BusConformance, OpeningTwiceIsAnErrorThatNamesTheBus) {
  open_both();
  base::Diagnostics diagnostics;
  EXPECT_FALSE(first().open({}, diagnostics));
  EXPECT_THAT(diagnostics.to_text(), HasSubstr("'" + first().name() + "'"));
  EXPECT_NE(first().state(), BusState::kClosed) << "it stays as it was";
}

TEST_P(BusConformance, EveryWrongOptionIsNamed) {
  BusOptions options;
  options.filters = {{0x800, 0x7ff, false}};
  options.receive_capacity = 0;
  base::Diagnostics diagnostics;
  EXPECT_FALSE(first().open(options, diagnostics));
  EXPECT_EQ(diagnostics.error_count(), 2u);
  EXPECT_THAT(diagnostics.to_text(), HasSubstr("'" + first().name() + "'"));
  EXPECT_THAT(diagnostics.to_text(), HasSubstr("at most 11 bits"));
  EXPECT_THAT(diagnostics.to_text(), HasSubstr("receive_capacity"));
  EXPECT_EQ(first().state(), BusState::kClosed);
}

TEST_P(BusConformance, AfterReopeningNothingOldIsReceived) {
  open_both();
  send(first(), data_frame(1, {}));
  second().close();
  EXPECT_EQ(second().state(), BusState::kClosed);
  open(second());
  send(first(), data_frame(2, {}));
  EXPECT_THAT(received(second()), ElementsAre("002#"));
}

TEST_P(BusConformance, AfterBusOffItSendsNothingUntilItWasRestarted) {
  open_both();
  if (!rig_->force_bus_off()) GTEST_SKIP() << "cannot be driven bus-off";
  ASSERT_TRUE(rig_->wait_for([this] { return state_when_read() == BusState::kBusOff; }));
  EXPECT_EQ(first().send(data_frame(1, {})), SendStatus::kBusOff);
  EXPECT_EQ(first().counters().bus_offs, 1u);
  rig_->restart();
  rig_->settle();
  ASSERT_TRUE(rig_->wait_for([this] { return state_when_read() == BusState::kActive; }));
  EXPECT_EQ(first().restart(), RestartStatus::kNotNeeded);
  send(first(), data_frame(2, {}));
  EXPECT_THAT(received(second()), ElementsAre("002#"));
}

}  // namespace armature::can::internal
