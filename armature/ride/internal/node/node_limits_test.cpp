// SPDX-License-Identifier: Apache-2.0
// What one client, or all together, may take of a node.
#include <algorithm>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>

#include "armature/ride/internal/node_rig.hpp"

namespace armature::ride {
namespace {

using namespace std::chrono_literals;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST_F(NodeTest, ABodyAboveTheLimitIsTooLargeAndTheNextIsTaken) {
  options_.limits.body_bytes = 100'000;
  auto raw = client();
  raw.send({}, Type::kRequest, 1, kEcho, 3u, std::string(200'000, 'y'));
  const auto refusal = raw.receive_control();
  EXPECT_EQ(refusal.code, Code::kTooLarge);
  EXPECT_EQ(refusal.call, 3u);
  EXPECT_EQ(refusal.operation, kEcho);
  raw.send({}, Type::kRequest, 1, kEcho, 4u, "small");
  EXPECT_EQ(raw.receive_reply<std::string>(4), "small");
}

TEST_F(NodeTest, WhatCameBeforeTheEndIsExecutedAndTheEndIsSeen) {
  auto other = client();
  other.send({}, Type::kCommand, 1, kStart);
  camera_.wait_until_started();
  {
    auto brief = client();
    brief.send({}, Type::kCommand, 1, kNote, 5);
  }
  camera_.let_go();
  EXPECT_THAT(camera_.wait_for_notes(1), ElementsAre(5));
  const auto end = std::chrono::steady_clock::now() + 20s;
  while (node_->statistics().connections != 1 && std::chrono::steady_clock::now() < end) {
    std::this_thread::yield();
  }
  EXPECT_EQ(node_->statistics().connections, 1u);
}

TEST_F(NodeTest, MoreMessagesThanWaitAtOnceAreAllExecuted) {
  constexpr std::int32_t kMany = 150'000;
  options_.limits.messages_per_second = 2 * kMany;
  auto other = client();
  other.send({}, Type::kCommand, 1, kStart);
  camera_.wait_until_started();
  Body all;
  for (std::int32_t i = 0; i < kMany; ++i) {
    all.append(RawClient::message({}, Type::kCommand, 1, kNote, i).bytes());
  }
  std::thread sender([&] {
    auto busy = client();
    busy.send(all.bytes());
    busy.receive();  // Until the test ends the node.
  });
  camera_.let_go();
  const auto notes = camera_.wait_for_notes(kMany);
  EXPECT_EQ(notes.size(), static_cast<std::size_t>(kMany));
  EXPECT_TRUE(std::ranges::is_sorted(notes));
  node_->remove(camera_);
  node_.reset();
  sender.join();
}

TEST_F(NodeTest, SubscriptionsAreRefusedByTheCodesNumber) {
  options_.limits.subscriptions = 1;
  auto raw = client();
  const Number event = event_number(static_cast<const ObjectPosition*>(nullptr));
  EXPECT_EQ(raw.subscribe(7, event, 1), 1);
  EXPECT_EQ(raw.subscribe(1, 12345u, 1), 2);
  EXPECT_EQ(raw.subscribe(1, event, 1), 0);
  EXPECT_EQ(raw.subscribe(1, event, 2), 7) << "one subscription is the limit here";
  raw.send({}, Type::kRequest, 0, internal::kUnsubscribe, 1u, 1);
  EXPECT_EQ(raw.receive_reply<std::int32_t>(1), 0);
  raw.send({}, Type::kRequest, 0, internal::kUnsubscribe, 1u, 1);
  EXPECT_EQ(raw.receive_reply<std::int32_t>(1), 1);
}

TEST_F(NodeTest, TheSameEventIsSubscribedToAFewTimesOnly) {
  options_.limits.subscriptions_to_an_event = 2;
  auto raw = client();
  const Number event = event_number(static_cast<const ObjectPosition*>(nullptr));
  EXPECT_EQ(raw.subscribe(1, event, 1), 0);
  EXPECT_EQ(raw.subscribe(1, event, 2), 0);
  EXPECT_EQ(raw.subscribe(1, event, 3), 7);
  EXPECT_EQ(raw.subscribe(1, kFailedDeclaration.number(), 3), 0) << "another event";
  EXPECT_THAT(log(), Contains(HasSubstr("was refused a subscription: BUSY")));
  EXPECT_EQ(client().subscribe(1, event, 1), 0) << "of another connection";
}

TEST_F(NodeTest, ASlowSubscriberLosesItsOldestEventsAndHoldsUpNobody) {
  options_.limits.unsent_bytes = 4096;
  options_.limits.events_per_subscription = 8;
  auto slow = client();
  const Number event = event_number(static_cast<const ObjectPosition*>(nullptr));
  ASSERT_EQ(slow.subscribe(1, event, 1), 0);
  std::int32_t raised = 0;
  while (node_->statistics().events_dropped == 0) camera_.raise({raised++, 0});
  for (int i = 0; i < 20; ++i) camera_.raise({raised++, 0});
  std::int32_t last = -1;
  std::int32_t gaps = 0;
  while (last != raised - 1) {
    const auto received = slow.receive();
    ASSERT_TRUE(received.has_value()) << "after " << last << " of " << raised;
    Decoder from(received->body);
    Number number = 0;
    ObjectPosition position;
    ASSERT_TRUE(from.take(number) && from.take(position));
    ASSERT_GT(position.x, last);
    if (position.x != last + 1) ++gaps;
    last = position.x;
  }
  EXPECT_EQ(gaps, 1) << "what was lost is the oldest of the queue";
}

/// What the connection could not take yet goes by urgency, and each event in its own order.
TEST_F(NodeTest, ASlowSubscriberGetsTheMostUrgentEventsFirst) {
  options_.limits.unsent_bytes = 4096;
  auto slow = client();
  ASSERT_EQ(slow.subscribe(1, event_number(static_cast<const ObjectPosition*>(nullptr)), 1), 0);
  ASSERT_EQ(slow.subscribe(1, event_number(static_cast<const Failed*>(nullptr)), 2), 0);
  std::int32_t raised = 0;
  while (node_->statistics().events_dropped == 0) camera_.raise({raised++, 0});
  camera_.alarm({"stop", "it is stuck"}, {255});
  camera_.alarm({"stop", "it is lost"}, {255});
  std::uint32_t positions_behind = 0;
  std::vector<std::string> alarms;
  for (std::int32_t last = -1; last != raised - 1 || alarms.size() < 2;) {
    const auto received = slow.receive();
    ASSERT_TRUE(received.has_value()) << "after " << last << " of " << raised;
    Decoder from(received->body);
    Number number = 0;
    ASSERT_TRUE(from.take(number));
    if (received->header.identifier == 2) {
      Failed failed;
      ASSERT_TRUE(from.take(failed));
      alarms.push_back(failed.text);
      continue;
    }
    ObjectPosition position;
    ASSERT_TRUE(from.take(position));
    last = position.x;
    if (alarms.size() == 2) ++positions_behind;
  }
  EXPECT_THAT(alarms, ElementsAre("it is stuck", "it is lost"));
  EXPECT_EQ(positions_behind, options_.limits.events_per_subscription);
}

TEST_F(NodeTest, AConnectionBeyondTheLimitIsSentAway) {
  options_.limits.connections = 1;
  auto first = client();
  first.send({}, Type::kControl, 0, Control{Code::kPing, 0, 0, 0, ""});
  EXPECT_EQ(first.receive_control().code, Code::kPong);
  auto second = client();
  EXPECT_FALSE(second.receive().has_value());
  EXPECT_EQ(node_->statistics().connections_refused, 1u);
  EXPECT_THAT(log(), Contains(HasSubstr("was sent away")));
}

TEST_F(NodeTest, ConnectionsThatComeFasterThanTheLimitWaitAndAreServed) {
  options_.limits.connections_per_second = 10;
  serve();
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 4; ++i) {
    auto raw = client();
    raw.send({}, Type::kControl, 0, Control{Code::kPing, 0, 0, 0, ""});
    EXPECT_EQ(raw.receive_control().code, Code::kPong);
  }
  EXPECT_GE(std::chrono::steady_clock::now() - begin, 200ms) << "two come at once";
  EXPECT_EQ(node_->statistics().connections_refused, 0u);
}

TEST_F(NodeTest, AMessageThatDoesNotEndInTimeIsTheEnd) {
  options_.limits.time_to_complete = 1ms;
  auto raw = client();
  raw.send(bytes_of("52494445 0000"));
  EXPECT_FALSE(raw.receive().has_value());
  EXPECT_THAT(log(), Contains(HasSubstr("its message did not end in time")));
}

TEST_F(NodeTest, WhoSendsTooManyMessagesHasToWaitAndLosesNone) {
  options_.limits.messages_per_second = 10;
  auto raw = client();
  for (int i = 0; i < 40; ++i) {
    raw.send({}, Type::kControl, 0, Control{Code::kPing, 0, 0, 0, std::to_string(i)});
  }
  for (int i = 0; i < 40; ++i) ASSERT_EQ(raw.receive_control().text, std::to_string(i));
}

TEST_F(NodeTest, WhoDoesNotTakeItsAnswersIsNotReadUntilItDoes) {
  options_.limits.unsent_bytes = 4096;
  auto raw = client();
  constexpr std::uint32_t kCount = 2000;
  std::thread sending([&] {
    for (std::uint32_t i = 1; i <= kCount; ++i) {
      raw.send({}, Type::kRequest, 1, kEcho, i, std::string(10'000, 'x'));
    }
  });
  while (node_->statistics().messages < 100) std::this_thread::yield();
  for (std::uint32_t i = 1; i <= kCount; ++i) {
    ASSERT_EQ(raw.receive_reply<std::string>(i).value_or("").size(), 10'000u) << i;
  }
  sending.join();
}

TEST_F(NodeTest, WhoSendsNoMoreGetsTheAnswersThatItIsOwed) {
  auto raw = client();
  raw.send({}, Type::kRequest, 1, kLater, 1u);
  raw.send({}, Type::kRequest, 1, kEcho, 2u, "soon");
  ::shutdown(raw.handle(), SHUT_WR);
  EXPECT_EQ(raw.receive_reply<std::string>(2), "soon");
  ASSERT_EQ(camera_.kept.size(), 1u);
  camera_.kept[0].put(std::int32_t{5});
  EXPECT_EQ(raw.receive_reply<std::int32_t>(1), 5);
  EXPECT_FALSE(raw.receive().has_value()) << "and is disconnected once it is owed nothing";
}

TEST_F(NodeTest, WhoHasLeftMakesRoomForOthers) {
  options_.limits.connections = 1;
  auto first = client();
  first.send({}, Type::kRequest, 1, kLater, 1u);
  first.send({}, Type::kControl, 0, Control{Code::kPing, 0, 0, 0, ""});
  EXPECT_EQ(first.receive_control().code, Code::kPong);
  ::shutdown(first.handle(), SHUT_WR);
  for (bool served = false; !served;) {
    auto second = client();
    second.send({}, Type::kControl, 0, Control{Code::kPing, 0, 0, 0, ""});
    served = second.receive_control().code == Code::kPong;
  }
  camera_.kept.clear();
}

TEST_F(NodeTest, HelloHasNameAndVersion) {
  options_.name = "head";
  auto raw = client();
  raw.send({}, Type::kControl, 0, Control{Code::kHello, 0, 0, 0, "tester 1"});
  EXPECT_THAT(raw.receive_control().text, testing::MatchesRegex("head armature/[0-9.]+"));
}

TEST_F(NodeTest, ListeningWithoutAPolicyIsWarnedOf) {
  serve();
  EXPECT_THAT(log(), Contains(HasSubstr("everyone on this machine may do everything")));
}

TEST_F(NodeTest, WhenTooManyAnswersAreOwedItIsBusy) {
  options_.limits.pending_replies = 1;
  auto raw = client();
  raw.send({}, Type::kRequest, 1, kLater, 1u);
  raw.send({}, Type::kRequest, 1, kLater, 2u);
  const auto refusal = raw.receive_control();
  EXPECT_EQ(refusal.code, Code::kBusy);
  EXPECT_EQ(refusal.call, 2u);
  ASSERT_EQ(camera_.kept.size(), 1u);
  camera_.kept[0].put(std::int32_t{5});
  EXPECT_EQ(raw.receive_reply<std::int32_t>(1), 5);
}

TEST_F(NodeTest, ThePolicyDecidesByTheAccessOfAnOperation) {
  options_.allows = [](const AccessQuestion& question) {
    return question.transport == "tcp" && question.component == "camera" &&
           question.access == Access::kRead;
  };
  auto raw = client();
  raw.send({}, Type::kRequest, 1, kEcho, 1u, "read");
  EXPECT_EQ(raw.receive_reply<std::string>(1), "read");
  raw.send({}, Type::kRequest, 1, kSetThreshold, 2u, 1u, 2u, 3u);
  EXPECT_EQ(raw.receive_control().code, Code::kNotAllowed);
  raw.send({}, Type::kCommand, 1, kNote, 1);
  EXPECT_EQ(raw.receive_control().code, Code::kNotAllowed);
  EXPECT_EQ(raw.subscribe(1, event_number(static_cast<const ObjectPosition*>(nullptr)), 1), 0);
}

}  // namespace
}  // namespace armature::ride
