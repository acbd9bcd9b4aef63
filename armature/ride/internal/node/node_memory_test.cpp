// SPDX-License-Identifier: Apache-2.0
// What peers may make a node keep, and what becomes of the others meanwhile.
#include <algorithm>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/ride/internal/node_rig.hpp"

namespace armature::ride {
namespace {

using namespace std::chrono_literals;
using ::testing::Contains;
using ::testing::HasSubstr;

constexpr std::size_t kMiB = 1 << 20;

class NodeMemory : public NodeTest {
 protected:
  /// A request whose body goes on, of `parts` of about 64 KB, and has no end yet.
  static Body begun(std::uint32_t identifier, Number operation, int parts) {
    Body all;
    for (int i = 0; i < parts; ++i) {
      Body bytes;
      bytes.extend(Header::kSize);
      Encoder to(bytes);
      if (i == 0) {
        to.put(operation);
        to.put(1u);
        to.put(static_cast<std::uint32_t>(kMiB));
      }
      bytes.extend(60'000);
      finish_message(bytes, 0, {}, Type::kRequest, identifier);
      bytes.data()[9] = std::byte{0x80};
      all.append(bytes.bytes());
    }
    return all;
  }
  /// Once all that was sent before has been looked at.
  static void wait_for_all_of(RawClient& raw) {
    raw.send({}, Type::kControl, 0, Control{Code::kPing, 0, 0, 0, ""});
    Code code = raw.receive_control().code;
    while (code != Code::kPong && code != Code::kNone) code = raw.receive_control().code;
    EXPECT_EQ(code, Code::kPong);
  }
  std::uint64_t used() { return node_->statistics().memory_bytes; }
};

TEST_F(NodeMemory, WhoMayNotIsToldWithTheFirstPartAndNothingIsKept) {
  options_.allows = [](const AccessQuestion& question) { return question.access == Access::kRead; };
  auto raw = client();
  raw.send(begun(1, kSetThreshold, 1).bytes());
  const auto refusal = raw.receive_control();
  EXPECT_EQ(refusal.code, Code::kNotAllowed) << "with no end in sight";
  EXPECT_EQ(refusal.call, 1u);
  const std::uint64_t before = used();
  raw.send(begun(1, kSetThreshold, 30).bytes());
  wait_for_all_of(raw);
  EXPECT_EQ(used(), before);
}

TEST_F(NodeMemory, NothingIsKeptForWhatIsNotThere) {
  auto raw = client();
  raw.send(begun(7, kEcho, 1).bytes());
  EXPECT_EQ(raw.receive_control().code, Code::kNoSuchComponent);
  raw.send(begun(1, 12345, 1).bytes());
  EXPECT_EQ(raw.receive_control().code, Code::kNoSuchOperation);
  raw.send(begun(0, internal::kFind, 1).bytes());
  EXPECT_EQ(raw.receive_control().code, Code::kTooLarge);
}

TEST_F(NodeMemory, BodiesThatNeverEndKeepToTheBoundAndOthersAreServed) {
  options_.limits.memory_bytes = 16 * kMiB;
  options_.limits.time_to_complete = 60s;  // so that none of them ends by its age
  auto honest = client();
  std::vector<RawClient> hogs;
  for (int k = 0; k < 20; ++k) {
    hogs.push_back(client());
    hogs.back().send(begun(1, kEcho, 40).bytes());
    wait_for_all_of(hogs.back());
  }
  EXPECT_LE(used(), 16 * kMiB);
  EXPECT_GE(used(), 12 * kMiB) << "it is in use";
  honest.send({}, Type::kRequest, 1, kEcho, 2u, std::string(50'000, 'x'));
  EXPECT_EQ(honest.receive_reply<std::string>(2).value_or("").size(), 50'000u);
  for (RawClient& hog : hogs) {
    Body end;
    append_message(end, {}, Type::kRequest, 1, {});
    hog.send(end.bytes());
    const auto answer = hog.receive_control();
    EXPECT_TRUE(answer.code == Code::kBusy || answer.code == Code::kMalformed)
        << name_of(answer.code);
    EXPECT_EQ(answer.call, 1u);
  }
  hogs.clear();
  const auto end = std::chrono::steady_clock::now() + 20s;
  while (used() > kMiB && std::chrono::steady_clock::now() < end) std::this_thread::yield();
  EXPECT_LE(used(), kMiB) << "what ends gives all of it back";
}

TEST_F(NodeMemory, AnswersThatNobodyReadsKeepToTheBoundAndWhoDoesNotReadIsEnded) {
  options_.limits.memory_bytes = 16 * kMiB;
  options_.limits.unsent_bytes = 64 * kMiB;  // so that it is read on
  options_.limits.time_to_complete = 1s;
  auto honest = client();
  const auto request = RawClient::message({}, Type::kRequest, 1, kEcho, 1u, std::string(kMiB, 'x'));
  std::vector<RawClient> hogs;
  for (int k = 0; k < 4; ++k) {
    hogs.push_back(client());
    for (int i = 0; i < 16; ++i) hogs.back().send(request.bytes());
  }
  const auto end = std::chrono::steady_clock::now() + 20s;
  bool ended = false;
  while (!ended && std::chrono::steady_clock::now() < end) {
    EXPECT_LE(used(), 16 * kMiB);
    honest.send({}, Type::kRequest, 1, kEcho, 2u, "small");
    ASSERT_EQ(honest.receive_reply<std::string>(2), "small");
    ended = std::ranges::any_of(
        log(), [](const auto& line) { return line.find("other connections need") != line.npos; });
  }
  EXPECT_TRUE(ended);
}

TEST_F(NodeMemory, AnAnswerThatThereIsNoMemoryForIsToldAndTheNextIsGiven) {
  options_.limits.memory_bytes = 8 * kMiB;
  auto raw = client();
  raw.send({}, Type::kRequest, 1, kEcho, 1u, std::string(2 * kMiB, 'x'));
  const auto refusal = raw.receive_control();
  EXPECT_EQ(refusal.code, Code::kBusy);
  EXPECT_EQ(refusal.call, 1u);
  EXPECT_THAT(refusal.text, HasSubstr("not enough memory"));
  raw.send({}, Type::kRequest, 1, kEcho, 2u, std::string(kMiB / 2, 'x'));
  EXPECT_EQ(raw.receive_reply<std::string>(2).value_or("").size(), kMiB / 2);
}

TEST_F(NodeMemory, SubscriptionsAreCounted) {
  options_.limits.memory_bytes = 2 * kMiB;
  options_.limits.subscriptions_to_an_event = 1024;
  auto raw = client();
  const Number event = event_number(static_cast<const ObjectPosition*>(nullptr));
  std::int32_t count = 0;
  while (count < 1000 && raw.subscribe(1, event, count + 1) == 0) ++count;
  EXPECT_GT(count, 100);
  EXPECT_LT(count, 1000);
  EXPECT_LE(used(), 2 * kMiB);
  EXPECT_THAT(log(), Contains(HasSubstr("not enough memory for it")));
}

TEST_F(NodeMemory, AConnectionThatThereIsNoMemoryForIsSentAway) {
  options_.limits.memory_bytes = kMiB;
  auto first = client();
  wait_for_all_of(first);
  auto second = client();
  wait_for_all_of(second);
  EXPECT_FALSE(client().receive().has_value());
  EXPECT_THAT(log(), Contains(HasSubstr("use all the memory of this node")));
}

}  // namespace
}  // namespace armature::ride
