// SPDX-License-Identifier: Apache-2.0
// The calls of a connection whose answers have not come, and who reads it meanwhile.
#include "armature/ride/internal/open_calls.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <tuple>

#include <gtest/gtest.h>

#include "armature/ride/internal/reading.hpp"

namespace armature::ride::internal {
namespace {

class OpenCallsTest : public testing::Test {
 protected:
  bool answer(std::uint32_t id, std::int32_t value) {
    Body body;
    Encoder to(body);
    to.put(value);
    return calls_.complete(
        {.header = {.type = Type::kReply, .identifier = id}, .body = body.bytes()}, share_);
  }

  const std::shared_ptr<MemoryShare> share_ =
      std::make_shared<MemoryShare>(std::make_shared<MemoryBound>(1u << 20, 1u << 10), 1u << 10);
  OpenCalls calls_;
  std::int32_t result_ = 0;
  const Place place_{result_};
};

TEST_F(OpenCallsTest, AnAnswerGoesToItsCallOnce) {
  WaitingCall first(place_);
  WaitingCall second(place_);
  calls_.add(first);
  calls_.add(second);
  EXPECT_NE(first.id, second.id);
  EXPECT_TRUE(calls_.has(second.id));
  EXPECT_TRUE(answer(second.id, 7));
  EXPECT_TRUE(second.done);
  EXPECT_FALSE(first.done);
  EXPECT_EQ(result_, 7);
  EXPECT_FALSE(answer(second.id, 8)) << "nobody waits any more";
  EXPECT_EQ(result_, 7);
}

TEST_F(OpenCallsTest, ARefusalEndsItsCallWithTheCode) {
  WaitingCall call(place_);
  calls_.add(call);
  Body body;
  Encoder to(body);
  to.put(Control{Code::kBusy, 0, 0, 0, "later"});
  EXPECT_TRUE(calls_.complete(
      {.header = {.type = Type::kControl, .identifier = call.id}, .body = body.bytes()}, share_));
  EXPECT_EQ(call.code, Code::kBusy);
  EXPECT_EQ(call.text, "later");
}

TEST_F(OpenCallsTest, OneThatIsRemovedGetsNoAnswer) {
  WaitingCall call(place_);
  calls_.add(call);
  EXPECT_EQ(calls_.remove(call.id), &call);
  EXPECT_EQ(calls_.remove(call.id), nullptr);
  EXPECT_FALSE(answer(call.id, 7));
  EXPECT_FALSE(call.done);
}

TEST_F(OpenCallsTest, AllAreToldThatTheConnectionIsLost) {
  WaitingCall waiting(place_);
  std::string told;
  calls_.add(waiting);
  calls_.add(*new CallbackCall(
      [&](Code, std::string_view text, std::span<const std::byte>) { told = text; }));
  calls_.refuse_all(Code::kConnectionLost, "it is gone");
  EXPECT_EQ(waiting.code, Code::kConnectionLost);
  EXPECT_EQ(told, "it is gone");
  EXPECT_FALSE(calls_.has(waiting.id));
}

TEST_F(OpenCallsTest, OnlyACallThatAThreadWaitsForCanRead) {
  WaitingCall idle(place_);
  WaitingCall waiting(place_);
  waiting.waits = true;
  calls_.add(idle);
  EXPECT_EQ(calls_.first_waiting(), nullptr);
  calls_.add(waiting);
  EXPECT_EQ(calls_.first_waiting(), &waiting);
}

TEST(Reading, TheNodeTakesBackWhatNoCallerHasReadSinceItLookedLast) {
  Reading reading;
  EXPECT_TRUE(reading.is_of_node());
  reading.give_to_caller();
  reading.begin_return();
  EXPECT_FALSE(reading.take_back()) << "a caller reads";
  EXPECT_TRUE(reading.returns());
  reading.give_to_nobody();
  EXPECT_TRUE(reading.take_back());
  EXPECT_TRUE(reading.is_of_node());
  EXPECT_FALSE(reading.returns());
}

TEST(Reading, TheNodeLeavesItToCallersThatFollowEachOther) {
  Reading reading;
  reading.begin_return();
  for (int call = 0; call < 3; ++call) {
    reading.give_to_caller();
    reading.give_to_nobody();
    EXPECT_FALSE(reading.take_back());
    EXPECT_TRUE(reading.returns());
  }
  EXPECT_TRUE(reading.take_back());
}

TEST(Reading, TheNodeReadsWhatItIsToldOfUnlessACallerDoes) {
  Reading reading;
  EXPECT_FALSE(reading.claim_for_node()) << "it does already";
  reading.give_to_caller();
  EXPECT_FALSE(reading.claim_for_node());
  EXPECT_TRUE(reading.is_of_caller());
  reading.give_to_nobody();
  EXPECT_TRUE(reading.claim_for_node());
  EXPECT_TRUE(reading.is_of_node());
}

}  // namespace
}  // namespace armature::ride::internal
