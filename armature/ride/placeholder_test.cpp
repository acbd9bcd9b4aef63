// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/placeholder.hpp"

#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "armature/ride/internal/test_vision.hpp"
#include "armature/ride/node.hpp"
#include "armature/testing/kept_port.hpp"

namespace armature::ride {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr CallOptions kPatient{.deadline = 20s, .priority = {}};

/// Values that another thread brings.
template <typename T>
class Collected {
 public:
  void add(T value) {
    const std::lock_guard lock(mutex_);
    all_.push_back(std::move(value));
    changed_.notify_all();
  }
  /// Waits until there are so many.
  std::vector<T> wait_for(std::size_t count) {
    std::unique_lock lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, 20s, [&] { return all_.size() >= count; }))
        << all_.size() << " of " << count;
    return all_;
  }
  std::size_t size() {
    const std::lock_guard lock(mutex_);
    return all_.size();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<T> all_;
};

class Camera : public VisionService {
 public:
  std::int32_t initialize() override { throw Failure("the lens cap is on"); }
  void start() override { throw Failure("the shutter is stuck"); }
  void note(std::int32_t what) override { notes.add(what); }
  void later(PendingReply reply) override {
    kept.add(std::make_shared<PendingReply>(std::move(reply)));
  }

  Collected<std::int32_t> notes;
  Collected<std::shared_ptr<PendingReply>> kept;
};

NodeOptions quick() {
  NodeOptions options;
  options.reconnection.first = 1ms;
  options.reconnection.most = 10ms;
  return options;
}

/// A camera behind a server, and a client, over TCP and over a socket file.
class PlaceholderTest : public ::testing::TestWithParam<const char*> {
 protected:
  PlaceholderTest() {
    serve();
    connected(client_);
  }

  void serve() {
    server_.emplace(server_options_);
    EXPECT_EQ(server_->add("camera", camera_).value(), 1u);  // Before anybody can look for it.
    const auto got = server_->listen(address_);
    ASSERT_TRUE(got.ok()) << got.error();
  }
  Peer& peer() { return client_.connect(address_); }
  Peer& connected(Node& client) {
    Peer& peer = client.connect(address_);
    EXPECT_TRUE(peer.wait_until_connected(20s).ok());
    return peer;
  }

  const testing::KeptPort port_;
  const std::string address_ =
      GetParam() == std::string("tcp")
          ? port_.address()
          : "unix:" + ::testing::TempDir() + "ride_placeholder_" + std::to_string(::getpid());
  NodeOptions server_options_;
  Camera camera_;
  std::optional<Node> server_;
  Node client_{quick()};
};

INSTANTIATE_TEST_SUITE_P(All, PlaceholderTest, ::testing::Values("tcp", "unix"),
                         [](const auto& which) { return which.param; });

TEST_P(PlaceholderTest, ARequestBringsTheResult) {
  VisionPlaceholder camera(peer(), "camera");
  for (std::uint32_t i = 0; i < 100; ++i) {
    const auto sum = camera.setThreshold(i, 2, 3, kPatient);
    ASSERT_TRUE(sum.ok()) << sum.error();
    EXPECT_EQ(sum.value(), static_cast<std::int32_t>(i + 5));
  }
  EXPECT_EQ(camera.echo("grüße", kPatient).value(), "grüße");
}

TEST_P(PlaceholderTest, ALargeBodyGoesBothWays) {
  VisionPlaceholder camera(peer(), "camera");
  const std::string large(3'000'000, 'x');
  const auto answer = camera.echo(large, kPatient);
  ASSERT_TRUE(answer.ok()) << answer.error();
  EXPECT_TRUE(answer.value() == large);
}

TEST_P(PlaceholderTest, TheLargestBodyThereMayBeGoesBothWaysAndLeavesNothing) {
  constexpr std::size_t kOperationAndCallAndSize = 12;
  VisionPlaceholder camera(peer(), "camera");
  const std::string largest(Limits().body_bytes - kOperationAndCallAndSize, 'x');
  for (int i = 0; i < 3; ++i) {
    const auto answer = camera.echo(largest, kPatient);
    ASSERT_TRUE(answer.ok()) << answer.error();
    ASSERT_TRUE(answer.value() == largest);
  }
  const auto end = std::chrono::steady_clock::now() + 20s;
  const auto used = [&] { return server_->statistics().memory_bytes; };
  while (used() > (1 << 20) && std::chrono::steady_clock::now() < end) std::this_thread::yield();
  EXPECT_LE(used(), 1 << 20);
}

TEST_P(PlaceholderTest, ABodyAboveTheLimitIsTooLarge) {
  VisionPlaceholder camera(peer(), "camera");
  const auto answer = camera.echo(std::string(17 << 20, 'x'), kPatient);
  EXPECT_EQ(answer.code(), Code::kTooLarge) << answer.error();
  EXPECT_EQ(camera.setThreshold(1, 2, 3, kPatient).value(), 6);
}

TEST_P(PlaceholderTest, CommandsAreExecutedInTheirOrder) {
  VisionPlaceholder camera(peer(), "camera");
  for (int i = 0; i < 1000; ++i) ASSERT_EQ(camera.note(i), Sent::kYes);
  const auto notes = camera_.notes.wait_for(1000);
  for (int i = 0; i < 1000; ++i) ASSERT_EQ(notes[static_cast<std::size_t>(i)], i);
}

TEST_P(PlaceholderTest, AnOperationThatFailsSaysWhy) {
  VisionPlaceholder camera(peer(), "camera");
  const auto answer = camera.initialize(kPatient);
  EXPECT_EQ(answer.code(), Code::kFailed);
  EXPECT_EQ(answer.error(), "'camera' at " + address_ + ", initialize: FAILED: the lens cap is on");
}

TEST_P(PlaceholderTest, ACommandThatFailsIsToldByAnEvent) {
  VisionPlaceholder camera(peer(), "camera");
  Collected<std::string> failures;
  const auto told = camera.on_failed(
      [&](const Failed& failed) { failures.add(failed.operation + ": " + failed.text); });
  EXPECT_EQ(camera.start(), Sent::kYes);
  EXPECT_THAT(failures.wait_for(1), ElementsAre("start: the shutter is stuck"));
  EXPECT_EQ(server_->statistics().commands_failed, 1u);
}

TEST_P(PlaceholderTest, WhatIsNotThereIsRefused) {
  VisionPlaceholder camera(peer(), "camera");
  EXPECT_EQ(camera.unknown(kPatient).code(), Code::kNoSuchOperation);
  EXPECT_EQ(camera.malformed(kPatient).code(), Code::kMalformed);
  VisionPlaceholder microphone(peer(), "microphone");
  const auto answer = microphone.setThreshold(1, 2, 3, kPatient);
  EXPECT_EQ(answer.code(), Code::kNoSuchComponent) << answer.error();
  EXPECT_EQ(microphone.start(), Sent::kNotConnected);
  server_->remove(camera_);
  EXPECT_EQ(camera.setThreshold(1, 2, 3, kPatient).code(), Code::kNoSuchComponent);
  EXPECT_EQ(server_->statistics().refusals, 3u);
}

TEST_P(PlaceholderTest, APeerListsItsComponents) {
  Camera second;
  server_->add("second", second).value();
  const auto listed = peer().components(20s);
  ASSERT_TRUE(listed) << listed.error();
  ASSERT_EQ(listed.value().size(), 2u);
  EXPECT_EQ(listed.value()[0].name + listed.value()[1].name, "camerasecond");
  EXPECT_EQ(listed.value()[0].interface, "Vision");
  server_->remove(second);
}

TEST_P(PlaceholderTest, AnotherInterfaceIsNotTakenForTheRightOne) {
  static constexpr Interface kOther{"Microphone", kVisionDeclarations};
  VisionPlaceholder camera(peer(), "camera", kOther);
  EXPECT_EQ(camera.setThreshold(1, 2, 3, kPatient).code(), Code::kNoSuchComponent);
}

TEST_P(PlaceholderTest, ARequestEndsWithItsDeadline) {
  VisionPlaceholder camera(peer(), "camera");
  EXPECT_EQ(camera.later({.deadline = 1ms, .priority = {}}).code(), Code::kDeadline);
  const auto kept = camera_.kept.wait_for(1);
  kept[0]->put(std::int32_t{5});
  EXPECT_EQ(camera.setThreshold(1, 2, 3, kPatient).value(), 6) << "not the answer that was late";
}

TEST_P(PlaceholderTest, AnAnswerCanBeGivenLaterByAnotherThread) {
  VisionPlaceholder camera(peer(), "camera");
  std::thread answering([&] { camera_.kept.wait_for(1)[0]->put(std::int32_t{42}); });
  EXPECT_EQ(camera.later(kPatient).value(), 42);
  answering.join();
}

TEST_P(PlaceholderTest, AnAnswerThatIsLetGoIsAFailure) {
  class Forgetful : public VisionService {
    void later(PendingReply) override {}
  } forgetful;
  server_->add("forgetful", forgetful).value();
  VisionPlaceholder camera(peer(), "forgetful");
  const auto answer = camera.later(kPatient);
  EXPECT_EQ(answer.code(), Code::kFailed);
  EXPECT_THAT(answer.error(), HasSubstr("dropped the request without an answer"));
  server_->remove(forgetful);
}

TEST_P(PlaceholderTest, ManyThreadsCallAtTheSameTime) {
  VisionPlaceholder camera(peer(), "camera");
  std::vector<std::thread> threads;
  std::atomic<int> wrong{0};
  for (std::uint32_t t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      for (std::uint32_t i = 0; i < 2000; ++i) {
        const auto sum = camera.setThreshold(t, i, 0, kPatient);
        if (!sum.ok() || sum.value() != static_cast<std::int32_t>(t + i)) ++wrong;
      }
    });
  }
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
}

TEST_P(PlaceholderTest, SixteenSubscribersOfAProcessAreOneOnTheWire) {
  NodeOptions silent = quick();
  silent.reconnection.silence = 0s;  // An answer to PING would be a message, too.
  Node client(silent);
  VisionPlaceholder camera(connected(client), "camera");
  Collected<ObjectPosition> seen;
  std::vector<Subscription> subscriptions;
  for (int i = 0; i < 16; ++i) {
    subscriptions.push_back(
        camera.on_ObjectPosition([&](const ObjectPosition& position) { seen.add(position); }));
  }
  ASSERT_TRUE(camera.setThreshold(1, 2, 3, kPatient).ok()) << "they are there before this answer";
  const auto before = client.statistics().messages;
  camera_.raise({3, 4});
  const auto all = seen.wait_for(16);
  EXPECT_EQ(all.back(), (ObjectPosition{3, 4}));
  EXPECT_EQ(client.statistics().messages - before, 1u);
}

TEST_P(PlaceholderTest, AfterItsSubscriptionHasEndedAHandlerIsNotCalled) {
  VisionPlaceholder camera(peer(), "camera");
  Collected<ObjectPosition> first;
  Collected<ObjectPosition> second;
  auto ending = std::optional(
      camera.on_ObjectPosition([&](const ObjectPosition& position) { first.add(position); }));
  const auto staying =
      camera.on_ObjectPosition([&](const ObjectPosition& position) { second.add(position); });
  ASSERT_TRUE(camera.setThreshold(1, 2, 3, kPatient).ok());
  camera_.raise({1, 1});
  first.wait_for(1);
  ending.reset();
  camera_.raise({2, 2});
  EXPECT_THAT(second.wait_for(2), ElementsAre(ObjectPosition{1, 1}, ObjectPosition{2, 2}));
  EXPECT_EQ(first.size(), 1u);
}

TEST_P(PlaceholderTest, AHandlerMayEndItsOwnSubscriptionAndCallTheComponent) {
  VisionPlaceholder camera(peer(), "camera");
  Collected<std::int32_t> sums;
  std::optional<Subscription> subscription;
  subscription = camera.on_ObjectPosition([&](const ObjectPosition&) {
    subscription.reset();
    sums.add(camera.setThreshold(1, 2, 3, kPatient).value());
  });
  ASSERT_TRUE(camera.setThreshold(1, 2, 3, kPatient).ok());
  camera_.raise({1, 1});
  EXPECT_THAT(sums.wait_for(1), ElementsAre(6));
  camera_.raise({2, 2});
  ASSERT_TRUE(camera.setThreshold(1, 2, 3, kPatient).ok());
  EXPECT_EQ(sums.size(), 1u);
}

TEST_P(PlaceholderTest, WhatArrivesWhileAHandlerCallsDoesNotChangeItsEvent) {
  VisionPlaceholder camera(peer(), "camera");
  Collected<ObjectPosition> first;
  Collected<ObjectPosition> second;
  const auto calling = camera.on_ObjectPosition([&](const ObjectPosition& position) {
    if (position.x == 1) {
      camera_.raise({2, 2});
      EXPECT_EQ(camera.setThreshold(1, 2, 3, kPatient).value(), 6);
    }
    first.add(position);
  });
  const auto other =
      camera.on_ObjectPosition([&](const ObjectPosition& position) { second.add(position); });
  ASSERT_TRUE(camera.setThreshold(1, 2, 3, kPatient).ok());
  camera_.raise({1, 1});
  EXPECT_THAT(second.wait_for(2), ElementsAre(ObjectPosition{1, 1}, ObjectPosition{2, 2}));
  EXPECT_THAT(first.wait_for(2), ElementsAre(ObjectPosition{1, 1}, ObjectPosition{2, 2}));
}

TEST_P(PlaceholderTest, EventsArriveWhileRequestsAreAnswered) {
  VisionPlaceholder camera(peer(), "camera");
  Collected<ObjectPosition> seen;
  const auto subscription =
      camera.on_ObjectPosition([&](const ObjectPosition& position) { seen.add(position); });
  ASSERT_TRUE(camera.setThreshold(1, 2, 3, kPatient).ok());
  for (int i = 0; i < 200; ++i) {
    camera_.raise({i, 0});
    ASSERT_TRUE(camera.setThreshold(1, 2, 3, kPatient).ok());
  }
  const auto all = seen.wait_for(200);
  for (int i = 0; i < 200; ++i) EXPECT_EQ(all[static_cast<std::size_t>(i)].x, i);
}

TEST_P(PlaceholderTest, AfterALossItComesBackAndSubscribesAnew) {
  VisionPlaceholder camera(peer(), "camera");
  Collected<bool> changes;
  Collected<ObjectPosition> seen;
  const auto told =
      peer().on_change([&](const PeerChange& change) { changes.add(change.connected); });
  const auto subscription =
      camera.on_ObjectPosition([&](const ObjectPosition& position) { seen.add(position); });
  ASSERT_TRUE(camera.setThreshold(1, 2, 3, kPatient).ok());
  server_.reset();
  changes.wait_for(1);
  EXPECT_EQ(camera.setThreshold(1, 2, 3, kPatient).code(), Code::kNotConnected);
  EXPECT_EQ(camera.start(), Sent::kNotConnected);
  serve();
  EXPECT_THAT(changes.wait_for(2), ElementsAre(false, true));
  EXPECT_EQ(peer().losses(), 1u);
  ASSERT_TRUE(camera.setThreshold(1, 2, 3, kPatient).ok());
  camera_.raise({7, 7});
  EXPECT_THAT(seen.wait_for(1), ElementsAre(ObjectPosition{7, 7}));
}

TEST_P(PlaceholderTest, ARequestThatIsOpenWhenTheConnectionBreaksFailsAtOnce) {
  VisionPlaceholder camera(peer(), "camera");
  std::thread breaking([&] {
    camera_.kept.wait_for(1);
    server_.reset();
  });
  const auto answer = camera.later(kPatient);
  breaking.join();
  EXPECT_EQ(answer.code(), Code::kConnectionLost) << answer.error();
  EXPECT_THAT(answer.error(), HasSubstr("'camera' at " + address_ + ", later: connection lost"));
}

TEST_P(PlaceholderTest, WhatWasSentBeforeALossIsNotSentAgain) {
  VisionPlaceholder camera(peer(), "camera");
  ASSERT_EQ(camera.note(1), Sent::kYes);
  camera_.notes.wait_for(1);
  Collected<bool> changes;
  const auto told =
      peer().on_change([&](const PeerChange& change) { changes.add(change.connected); });
  server_.reset();
  serve();
  changes.wait_for(2);
  ASSERT_EQ(camera.note(2), Sent::kYes);
  EXPECT_THAT(camera_.notes.wait_for(2), ElementsAre(1, 2));
}

TEST_P(PlaceholderTest, ThePeerOfAnAddressIsAlwaysTheSame) {
  EXPECT_EQ(&peer(), &client_.connect(address_));
}

TEST(Peer, SaysWhatIsInTheWay) {
  Node node;
  const auto refused = node.connect("unix:/no/such/place").wait_until_connected(1ms);
  ASSERT_FALSE(refused.ok());
  EXPECT_THAT(refused.error(), HasSubstr("'unix:/no/such/place' is not connected"));
  EXPECT_THAT(node.connect("nonsense").wait_until_connected(0s).error(),
              HasSubstr("has no transport"));
  EXPECT_THAT(node.connect("tls://127.0.0.1:1").wait_until_connected(0s).error(),
              HasSubstr("has no transport 'tls'"));
}

}  // namespace
}  // namespace armature::ride
