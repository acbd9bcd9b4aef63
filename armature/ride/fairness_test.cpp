// SPDX-License-Identifier: Apache-2.0
// One connection's flood and what others have sent.
#include <algorithm>
#include <chrono>
#include <deque>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/platform/clock.hpp"
#include "armature/ride/internal/node_rig.hpp"
#include "armature/ride/internal/pending.hpp"

namespace armature::ride {
namespace {

using namespace std::chrono_literals;
using internal::Message;
using internal::Pending;
using internal::Waiting;
using ::testing::ElementsAre;

class PendingTest : public testing::Test {
 protected:
  void push(Waiting& whose, std::uint32_t priority, std::uint32_t name) {
    pending_.push(whose, Message{.header = {.priority = priority, .identifier = name}, .body = {}});
  }
  std::vector<std::uint32_t> pop_all() {
    std::vector<std::uint32_t> names;
    while (!pending_.empty()) names.push_back(pending_.pop().message.header.identifier);
    return names;
  }

  Pending pending_;
  Waiting a_{nullptr};
  Waiting b_{nullptr};
  Waiting c_{nullptr};
};

TEST_F(PendingTest, TheMostUrgentComesFirstAndThenTheirOrder) {
  push(a_, 0, 1);
  push(a_, 9, 2);
  push(a_, 9, 3);
  push(a_, 255, 4);
  push(a_, 64, 5);
  EXPECT_THAT(pop_all(), ElementsAre(4, 5, 2, 3, 1));
}

TEST_F(PendingTest, AMoreUrgentOneOvertakesThoseOfOtherConnections) {
  push(a_, 1, 1);
  push(b_, 2, 2);
  push(c_, 3, 3);
  EXPECT_THAT(pop_all(), ElementsAre(3, 2, 1));
}

TEST_F(PendingTest, ConnectionsTakeTurns) {
  for (const std::uint32_t name : {11u, 12u, 13u}) push(a_, 0, name);
  for (const std::uint32_t name : {21u, 22u}) push(b_, 0, name);
  for (const std::uint32_t name : {31u, 32u}) push(c_, 0, name);
  EXPECT_THAT(pop_all(), ElementsAre(11, 21, 31, 12, 22, 32, 13));
}

TEST_F(PendingTest, WhoHasSentASingleSmallOneComesBeforeThoseWhoHaveSentMuch) {
  const std::vector<std::byte> large(4096);
  pending_.push(a_, Message{.header = {.identifier = 11}, .body = large});
  for (const std::uint32_t name : {21u, 22u}) push(b_, 0, name);
  push(c_, 0, 31);
  EXPECT_THAT(pop_all(), ElementsAre(31, 11, 21, 22));
}

TEST_F(PendingTest, WhoHasSentSomethingLargeHasNoTurnUntilItIsReleased) {
  Body large;
  large.extend(1 << 20);
  push(a_, 0, 11);
  pending_.push(a_, Message{.header = {.identifier = 12}, .body = large.bytes(), .whole = &large});
  pending_.hold_large();
  push(b_, 0, 21);
  EXPECT_THAT(pop_all(), ElementsAre(21));
  Body another;
  another.extend(1 << 20);
  pending_.push(c_,
                Message{.header = {.identifier = 31}, .body = another.bytes(), .whole = &another});
  EXPECT_TRUE(pending_.empty()) << "and nothing large that comes meanwhile";
  pending_.release_large();
  EXPECT_THAT(pop_all(), ElementsAre(11, 31, 12));
}

TEST_F(PendingTest, UrgentFloodsLetEveryoneHaveATurn) {
  constexpr std::size_t kFloods = 16;
  constexpr std::uint32_t kEach = 1000;
  std::deque<Waiting> floods;
  while (floods.size() < kFloods) {
    floods.emplace_back(nullptr);
    for (std::uint32_t i = 0; i < kEach; ++i) push(floods.back(), 255, 1);
  }
  push(a_, 0, 2);
  const auto order = pop_all();
  ASSERT_EQ(order.size(), kFloods * kEach + 1);
  EXPECT_LE(std::ranges::find(order, 2u) - order.begin(), 8 * (kFloods + 1));
}

TEST_F(PendingTest, ABodyLiesWhereItWasUntilTheNextPush) {
  const auto bytes = bytes_of("0102030405");
  pending_.push(a_, Message{.header = {.priority = 1}, .body = bytes});
  pending_.push(a_, Message{.header = {.priority = 2}, .body = std::span(bytes).first(2)});
  EXPECT_EQ(hex(pending_.pop().message.body), "0102");
  EXPECT_EQ(hex(pending_.pop().message.body), "0102030405");
}

/// A connection that floods a node, whose thread is busy, and another one with a single message.
class FloodTest : public NodeTest {
 protected:
  static constexpr int kFlood = 3000;
  static constexpr std::int32_t kMine = -1;

  /// How many of the flood were executed before the single one.
  std::ptrdiff_t executed_before_mine(Priority flood_priority) {
    auto flooder = client();
    auto other = client();
    other.send({}, Type::kControl, 0, Control{Code::kPing, 0, 0, 0, ""});
    EXPECT_EQ(other.receive_control().code, Code::kPong);
    flooder.send({}, Type::kCommand, 1, kStart);
    camera_.wait_until_started();
    Body flood;
    for (std::int32_t i = 0; i < kFlood; ++i) {
      flood.append(RawClient::message(flood_priority, Type::kCommand, 1, kNote, i).bytes());
    }
    flooder.send(flood.bytes());
    other.send({}, Type::kCommand, 1, kNote, kMine);
    camera_.let_go();
    const auto notes = camera_.wait_for_notes(kFlood + 1);
    EXPECT_EQ(notes.size(), kFlood + 1u);
    return std::ranges::find(notes, kMine) - notes.begin();
  }
};

TEST_F(FloodTest, HoldsUpOthersForAFewMessagesOnly) { EXPECT_LT(executed_before_mine({}), 100); }

TEST_F(FloodTest, HoldsUpOthersForAFewMessagesOnlyIfItIsUrgent) {
  EXPECT_LT(executed_before_mine({255}), 100);
}

TEST_F(FloodTest, WhoIsAlwaysInTheMiddleOfAMessageIsNotLate) {
  options_.limits.time_to_complete = 500ms;
  auto raw = client();
  const Body ping = RawClient::message({}, Type::kControl, 0, Control{Code::kPing, 0, 0, 0, "x"});
  constexpr std::size_t kBegun = 10;
  raw.send(ping.bytes().first(kBegun));
  Body chunk;
  chunk.append(ping.bytes().subspan(kBegun));
  chunk.append(ping.bytes().first(kBegun));
  const base::Time end = platform::monotonic_now() + 600ms;
  while (platform::monotonic_now() < end) {
    raw.send(chunk.bytes());
    ASSERT_EQ(raw.receive_control().code, Code::kPong);
  }
}

}  // namespace
}  // namespace armature::ride
