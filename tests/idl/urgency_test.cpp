// SPDX-License-Identifier: Apache-2.0
// Priorities that an interface gives its messages: what is urgent overtakes what waits.
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/platform/own_priority.hpp"
#include "armature/ride/node.hpp"
#include "urgency_client.hpp"
#include "urgency_service.hpp"

namespace armature::idl {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;

/// What several threads write down.
class Log {
 public:
  void note(const std::string& what) {
    const std::lock_guard lock(mutex_);
    lines_.push_back(what);
    changed_.notify_all();
  }
  std::vector<std::string> wait_for(std::size_t count) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, 20s, [&] { return lines_.size() >= count; });
    return lines_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::string> lines_;
};

/// Holds up a thread until it is let go.
class Gate {
 public:
  void hold() {
    std::unique_lock lock(mutex_);
    held_ = true;
    changed_.notify_all();
    changed_.wait_for(lock, 20s, [this] { return open_; });
  }
  void wait_until_held() {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, 20s, [this] { return held_; });
  }
  void open() {
    const std::lock_guard lock(mutex_);
    open_ = true;
    changed_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool held_ = false;
  bool open_ = false;
};

class Robot final : public urgency::RobotService {
 public:
  void hold() override { gate.hold(); }
  void move(std::int32_t x) override { log.note("move " + std::to_string(x) + served()); }
  void stop() override { log.note("stop" + served()); }
  std::int32_t where() override {
    log.note("where" + served());
    return 7;
  }
  using RobotService::raise;

  Gate gate;
  Log log;
  bool tells_priority = false;

 private:
  std::string served() const {
    return tells_priority ? " at " + std::to_string(platform::own_priority()) : "";
  }
};

struct Urgency : testing::Test {
  void connect(ride::ServingPriorities serving = {}) {
    ride::NodeOptions options;
    options.serving = serving;
    server.emplace(std::move(options));
    ASSERT_TRUE(server->add("robot", robot));
    ride::Peer& peer = client.connect(server->listen("tcp://127.0.0.1:0").value().text());
    placeholder.emplace(peer, "robot");
    ASSERT_TRUE(peer.wait_until_connected(20s));
  }

  Robot robot;
  std::optional<ride::Node> server;
  ride::Node client;
  std::optional<urgency::RobotPlaceholder> placeholder;
};

TEST_F(Urgency, AStopOvertakesPositions) {
  connect();
  placeholder->hold();
  robot.gate.wait_until_held();
  for (std::int32_t x = 1; x <= 5; ++x) placeholder->move(x);
  placeholder->stop();
  // Whatever was sent before a request is on its way when the request is.
  static_cast<void>(placeholder->where({.deadline = 10ms, .priority = {}}));
  robot.gate.open();
  EXPECT_THAT(robot.log.wait_for(7),
              ElementsAre("stop", "move 1", "move 2", "move 3", "move 4", "move 5", "where"));
}

TEST_F(Urgency, TheSenderMaySayAnother) {
  connect();
  placeholder->hold();
  robot.gate.wait_until_held();
  placeholder->move(1);
  placeholder->move(2, {201});
  placeholder->stop();
  static_cast<void>(placeholder->where({.deadline = 10ms, .priority = {255}}));
  robot.gate.open();
  EXPECT_THAT(robot.log.wait_for(4), ElementsAre("where", "move 2", "stop", "move 1"));
}

TEST_F(Urgency, AnEventOvertakesLessUrgentOnes) {
  connect();
  Gate first;
  Log handled;
  const auto positions = placeholder->on_Position([&](const urgency::Position& event) {
    if (event.x == 0) return first.hold();
    handled.note("position " + std::to_string(event.x));
  });
  const auto falls =
      placeholder->on_Fallen([&](const urgency::Fallen&) { handled.note("fallen"); });
  ASSERT_TRUE(placeholder->where().ok()) << "it has subscribed";
  robot.raise(urgency::Position{0});
  first.wait_until_held();
  for (std::int32_t x = 1; x <= 3; ++x) robot.raise(urgency::Position{x});
  robot.raise(urgency::Fallen{1});
  EXPECT_TRUE(placeholder->where().ok()) << "events that were raised before it are here";
  first.open();
  EXPECT_THAT(handled.wait_for(4), ElementsAre("fallen", "position 1", "position 2", "position 3"));
}

TEST_F(Urgency, TheServingThreadHasThePriorityOfTheMessage) {
  robot.tells_priority = true;
  connect({.most = 20, .least = 10});
  placeholder->move(1);
  placeholder->stop();
  static_cast<void>(placeholder->where());
  static_cast<void>(placeholder->where({.deadline = 20s, .priority = {255}}));
  const auto log = robot.log.wait_for(4);
  if (log.back() == "where at 0") GTEST_SKIP() << "the system grants no real-time priority";
  EXPECT_THAT(log, testing::UnorderedElementsAre("move 1 at 10", "stop at 17", "where at 13",
                                                 "where at 20"));
}

TEST(ServingPriorities, HaveTheirShareOfThoseOfTheThread) {
  constexpr ride::ServingPriorities kNone;
  EXPECT_EQ(kNone.of({0}), 0);
  EXPECT_EQ(kNone.of({255}), 0);
  constexpr ride::ServingPriorities kSome{.most = 60, .least = 40};
  EXPECT_EQ(kSome.of({0}), 40);
  EXPECT_EQ(kSome.of({128}), 50);
  EXPECT_EQ(kSome.of({255}), 60);
}

}  // namespace
}  // namespace armature::idl
