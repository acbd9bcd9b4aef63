// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/internal/outgoing.hpp"

#include <algorithm>
#include <chrono>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "armature/platform/clock.hpp"
#include "armature/ride/wire.hpp"

namespace armature::ride::internal {
namespace {

using namespace std::chrono_literals;

/// Takes as many bytes as the test lets it.
class Narrow final : public Connection {
 public:
  int handle() const override { return -1; }
  Progress establish() override { return Progress::kDone; }
  Progress send(std::span<const std::byte> bytes, std::size_t& sent) override {
    if (gone) return Progress::kGone;
    if (takes == 0) return Progress::kWantWrite;
    sent = std::min(takes, bytes.size());
    takes -= sent;
    taken.append(reinterpret_cast<const char*>(bytes.data()), sent);
    return Progress::kDone;
  }
  Progress receive(std::span<std::byte>, std::size_t&) override { return Progress::kWantRead; }
  Progress wait_and_receive(std::span<std::byte>, std::size_t&, base::Duration) override {
    return Progress::kWantRead;
  }
  void set_level(int level) override { levels.push_back(level); }
  void shut_down() override {}
  std::string other_end() const override { return "test"; }
  std::string problem() const override { return ""; }

  std::size_t takes = 0;
  bool gone = false;
  std::string taken;
  std::vector<int> levels;  ///< that it was told, in their order
};

class OutgoingTest : public testing::Test {
 protected:
  void append(std::string_view text, std::uint8_t priority = 0) {
    ASSERT_TRUE(
        out_.append({priority}, [&](Body& out) { out.append(std::as_bytes(std::span(text))); }));
  }

  Outgoing out_{nullptr};
  Narrow other_;
};

TEST_F(OutgoingTest, IsBlockedByWhoDoesNotTakeAllAndGoesOnWhereItStopped) {
  append("what is sent");
  other_.takes = 5;
  EXPECT_EQ(out_.transmit(other_), Progress::kWantWrite);
  EXPECT_TRUE(out_.blocked());
  EXPECT_EQ(out_.unsent(), 7u);
  append(", in order");
  other_.takes = 100;
  EXPECT_TRUE(out_.unblock());
  EXPECT_FALSE(out_.unblock());
  EXPECT_EQ(out_.transmit(other_), Progress::kDone);
  EXPECT_EQ(other_.taken, "what is sent, in order");
  EXPECT_TRUE(out_.empty());
}

TEST_F(OutgoingTest, IsStuckOnceNothingWasTakenForSoLong) {
  append("something");
  const base::Time before = platform::monotonic_now();
  EXPECT_FALSE(out_.is_stuck(before + 1h, 1s)) << "nobody has tried";
  static_cast<void>(out_.transmit(other_));
  EXPECT_FALSE(out_.is_stuck(before, 1s));
  EXPECT_TRUE(out_.is_stuck(platform::monotonic_now() + 1s, 1s));
}

TEST_F(OutgoingTest, TheConnectionHasTheLevelOfTheMostUrgentThatItIsToSend) {
  other_.takes = 100;
  append("positions");
  static_cast<void>(out_.transmit(other_));
  EXPECT_EQ(other_.levels, std::vector<int>{}) << "it begins with the least";
  append("position", 20);
  append("stop", 255);
  append("position", 20);
  static_cast<void>(out_.transmit(other_));
  EXPECT_EQ(other_.levels, std::vector<int>{6});
  append("stop", 254);
  static_cast<void>(out_.transmit(other_));
  EXPECT_EQ(other_.levels, std::vector<int>{6}) << "it is told what changes";
  append("slower", 128);
  static_cast<void>(out_.transmit(other_));
  append("position", 36);
  static_cast<void>(out_.transmit(other_));
  EXPECT_EQ(other_.levels, (std::vector{6, 3, 0}));
}

TEST_F(OutgoingTest, WhatIsLeftKeepsTheLevelUntilItIsSent) {
  append("stop", 255);
  static_cast<void>(out_.transmit(other_));
  append("position");
  other_.takes = 100;
  static_cast<void>(out_.transmit(other_));
  EXPECT_EQ(other_.levels, std::vector<int>{6});
  append("position");
  static_cast<void>(out_.transmit(other_));
  EXPECT_EQ(other_.levels, (std::vector{6, 0}));
}

TEST_F(OutgoingTest, SaysThatTheConnectionHasEnded) {
  append("something");
  other_.gone = true;
  EXPECT_EQ(out_.transmit(other_), Progress::kGone);
}

TEST_F(OutgoingTest, WhatFindsNoMemoryIsNotThereInPart) {
  append("before");
  EXPECT_FALSE(out_.append({}, [](Body& out) {
    out.append(std::as_bytes(std::span("half", 4)));
    throw std::bad_alloc();
  }));
  EXPECT_EQ(out_.unsent(), 6u);
}

TEST_F(OutgoingTest, AMessageAloneIsSentAtOnceAndThoseThatFollowItSoonWaitForEachOther) {
  const base::Time now(1h);
  EXPECT_EQ(out_.gather(now), Outgoing::Gather::kSend);
  EXPECT_EQ(out_.gather(now + 1us), Outgoing::Gather::kWaitAnew);
  EXPECT_EQ(out_.gather(now + 2us), Outgoing::Gather::kWait);
  EXPECT_EQ(out_.gathered_since(), now + 1us);
  append(std::string(8 * 1024, 'x'));
  EXPECT_EQ(out_.gather(now + 3us), Outgoing::Gather::kSend) << "so much does not wait";
  out_.end_gathering();
  EXPECT_EQ(out_.gather(now + 1ms), Outgoing::Gather::kSend) << "and it is alone again";
}

TEST_F(OutgoingTest, AnEventGoesToItsSubscriptionInEachOfItsParts) {
  Body event;
  for (int part = 0; part < 2; ++part) {
    const std::size_t start = event.size();
    event.extend(Header::kSize);
    finish_message(event, start, {}, Type::kEvent, 0);
  }
  ASSERT_TRUE(out_.append_event(7, event.bytes()));
  other_.takes = 1000;
  ASSERT_EQ(out_.transmit(other_), Progress::kDone);
  ASSERT_EQ(other_.taken.size(), 2 * Header::kSize);
  const auto* const bytes = reinterpret_cast<const std::byte*>(other_.taken.data());
  EXPECT_EQ(load<std::uint32_t>(bytes + 12), 7u);
  EXPECT_EQ(load<std::uint32_t>(bytes + Header::kSize + 12), 7u);
}

}  // namespace
}  // namespace armature::ride::internal
