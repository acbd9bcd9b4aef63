// SPDX-License-Identifier: Apache-2.0
// The pilot in a process of its own, as the robot's side sees it on the wire (paper 4, table 2).
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/deploy/deployment.hpp"
#include "armature/platform/clock.hpp"
#include "armature/remote/interface_file.hpp"
#include "armature/remote/network.hpp"
#include "armature/ride/node.hpp"
#include "rover_client.hpp"
#include "rover_service.hpp"
#include "tests/rover/wiretap.hpp"

namespace armature::rover {
namespace {

using namespace std::chrono_literals;

/// A visual component without any camera: sees what the test says.
class Eye final : public ::rover::VSService {
 public:
  std::int32_t initialize() override { return ++initialized_, 0; }
  std::int32_t setThreshold(std::uint32_t red, std::uint32_t, std::uint32_t) override {
    red_ = red;
    return 0;
  }
  void start() override { ++started_; }
  void stop() override { ++stopped_; }
  using VSService::raise;

  std::atomic<int> initialized_{0};
  std::atomic<std::uint32_t> red_{0};
  std::atomic<int> started_{0};
  std::atomic<int> stopped_{0};
};

/// A chassis that notes what it is told.
class Wheels final : public ::rover::ChassisService {
 public:
  struct Speeds {
    float left;
    float right;
  };
  void setVelocity(float left, float right) override {
    const std::scoped_lock lock(mutex_);
    told_.push_back({left, right});
  }
  /// To the left side, of those that turn to the right and are no search.
  std::vector<float> turns() const {
    constexpr float kSearch = 0.07F;
    std::vector<float> turns;
    for (const Speeds& each : told()) {
      if (each.left > 0.0F && each.left < kSearch) turns.push_back(each.left);
    }
    return turns;
  }
  std::vector<Speeds> told() const {
    const std::scoped_lock lock(mutex_);
    return told_;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<Speeds> told_;
};

/// The robot's side: a node that knows nothing but rover.idl.
struct RobotSide {
  RobotSide() {
    EXPECT_TRUE(node.add("Vision", eye));
    EXPECT_TRUE(node.add("Chassis.Drive", wheels));
    const auto listens = node.listen("tcp://127.0.0.1:0");
    EXPECT_TRUE(listens);
    const std::string address = listens.value().text();
    port = static_cast<std::uint16_t>(std::stoi(address.substr(address.rfind(':') + 1)));
  }
  Eye eye;
  Wheels wheels;
  ride::Node node;
  std::uint16_t port = 0;
};

/// pilot.yaml, run.
class PilotProcess {
 public:
  explicit PilotProcess(const std::string& address) : network_(remote::make_network({})) {
    deploy::DeploymentOptions how;
    how.library_folders = {LIBRARIES};
    how.document.overrides = {"vision=" + address, "chassis=" + address};
    how.make_placeholder = [this](const document::Component& written,
                                  std::unique_ptr<component::Component> prototype) {
      return network_->make_placeholder(written, std::move(prototype));
    };
    how.read_interface = remote::read_interface;
    deployment_ = deploy::load_deployment(ROVER "/deployments/pilot.yaml", how);
    EXPECT_TRUE(deployment_.ok()) << deployment_.diagnostics.to_text();
    application_ =
        std::make_unique<exec::Application>(std::move(deployment_.blueprint), deployment_.options);
    base::Diagnostics diagnostics;
    network_->open(deployment_.document, {}, *application_, diagnostics);
    diagnostics.append(application_->start());
    EXPECT_EQ(diagnostics.to_text(), "");
  }
  ~PilotProcess() {
    network_->leave();
    application_->stop();
  }
  bool serve_until(const std::function<bool()>& condition) {
    const base::Time end = platform::monotonic_now() + 30s;
    while (!condition()) {
      if (platform::monotonic_now() > end) return false;
      network_->serve();
      application_->drain_logs();
      std::this_thread::sleep_for(1ms);
    }
    return true;
  }
  exec::Application& application() { return *application_; }

 private:
  std::unique_ptr<remote::Network> network_;
  deploy::Deployment deployment_;
  std::unique_ptr<exec::Application> application_;
};

ride::Number number_of(const ride::Interface& interface, std::string_view name) {
  for (const ride::Declaration& each : interface.declarations) {
    if (each.canonical.find(name) != std::string_view::npos) return each.number();
  }
  return 0;
}
ride::Number number_of_vs(std::string_view name) { return number_of(::rover::kVS, name); }
ride::Number number_of_chassis(std::string_view name) { return number_of(::rover::kChassis, name); }

class PilotTest : public ::testing::Test {
 protected:
  /// @param delay  in each direction
  explicit PilotTest(base::Duration delay = {}) : tap_(robot_.port, delay) {}
  std::size_t count(ride::Type type, bool to_robot, ride::Number first = 0) const {
    const std::vector<Passed> all = tap_.passed();
    return static_cast<std::size_t>(std::ranges::count_if(all, [&](const Passed& each) {
      return each.header.type == type && each.to_robot == to_robot &&
             (first == 0 || each.first == first);
    }));
  }
  bool prepared() const { return robot_.eye.started_ > 0; }

  RobotSide robot_;
  Wiretap tap_;
};

TEST_F(PilotTest, RequestsAreAnsweredInTheOrderOfTheTasks) {
  PilotProcess pilot(tap_.address());
  ASSERT_TRUE(pilot.serve_until([&] { return prepared(); }));
  EXPECT_GE(robot_.eye.initialized_, 1);
  EXPECT_EQ(robot_.eye.red_, 255U);
  EXPECT_GE(count(ride::Type::kRequest, true, number_of_vs(" initialize(")), 1U);
  EXPECT_GE(count(ride::Type::kRequest, true, number_of_vs(" setThreshold(")), 1U);
  EXPECT_GE(count(ride::Type::kReply, false), 2U);
}

TEST_F(PilotTest, APositionComesAsAnEventAndSpeedsByTheFormulaGoBack) {
  PilotProcess pilot(tap_.address());
  ASSERT_TRUE(pilot.serve_until([&] { return prepared(); }));
  const auto follows = [&] {
    robot_.eye.raise(::rover::ObjectPositionEvent{200, 130});
    const auto told = robot_.wheels.told();
    return std::ranges::any_of(told, [](const Wheels::Speeds& speeds) {
      return std::abs(speeds.left - (0.0015F * 40 + 0.012F * 10)) < 1e-6F &&
             std::abs(speeds.right - (-0.0015F * 40 + 0.012F * 10)) < 1e-6F;
    });
  };
  EXPECT_TRUE(pilot.serve_until(follows));
  EXPECT_GE(count(ride::Type::kEvent, false, number_of_vs("ObjectPositionEvent")), 1U);
}

/// Speeds that the robot was asked for and has not answered, at most.
std::size_t most_open(const std::vector<Passed>& all) {
  std::set<ride::Number> open;
  std::size_t most = 0;
  for (const Passed& each : all) {
    if (each.to_robot && each.header.type == ride::Type::kRequest &&
        each.first == number_of_chassis("setVelocity")) {
      open.insert(each.second);
    }
    if (!each.to_robot && each.header.type == ride::Type::kReply)
      open.erase(each.header.identifier);
    most = std::max(most, open.size());
  }
  return most;
}

/// A round trip takes 300 ms, in which six positions come.
struct PilotFarAway : PilotTest {
  PilotFarAway() : PilotTest(150ms) {}
  /// Raises a position each 50 ms, farther to the right each time, as long as `goes_on`.
  void see(PilotProcess& pilot, const std::function<bool()>& goes_on) {
    base::Time next = platform::monotonic_now();
    EXPECT_TRUE(pilot.serve_until([&] {
      if (platform::monotonic_now() < next) return !goes_on();
      next += 50ms;
      robot_.eye.raise(::rover::ObjectPositionEvent{160 + ++seen_, 120});
      return !goes_on();
    }));
  }
  std::int64_t of_follow(PilotProcess& pilot, const char* item) {
    return *pilot.application().value_of("Follow", item).value().get_if<std::int64_t>();
  }
  int seen_ = 0;
};

TEST_F(PilotFarAway, GivesANewSpeedForEachPositionBeforeTheLastIsAnswered) {
  PilotProcess pilot(tap_.address());
  ASSERT_TRUE(pilot.serve_until([&] { return prepared(); }));
  see(pilot, [&] { return seen_ < 40; });
  EXPECT_TRUE(pilot.serve_until([&] {
    const auto turns = robot_.wheels.turns();
    return !turns.empty() && turns.back() > 0.0015F * 39.5F;
  }));
  EXPECT_GE(most_open(tap_.passed()), 3U);
  EXPECT_LE(4 * of_follow(pilot, "Refused"), of_follow(pilot, "Given"));
  const auto turns = robot_.wheels.turns();
  EXPECT_GE(turns.size(), 20U) << "of 40 positions";
  EXPECT_TRUE(std::ranges::is_sorted(turns)) << "they arrive in the order of the positions";
}

TEST_F(PilotFarAway, EachSpeedThatIsUnderWayFailsWhenTheConnectionIsLost) {
  PilotProcess pilot(tap_.address());
  ASSERT_TRUE(pilot.serve_until([&] { return prepared(); }));
  see(pilot, [&] { return most_open(tap_.passed()) < 3; });
  const std::int64_t given = of_follow(pilot, "Given");
  tap_.cut();
  EXPECT_TRUE(pilot.serve_until([&] { return of_follow(pilot, "Failures") >= 3; }));
  EXPECT_EQ(of_follow(pilot, "Given"), given) << "nothing is sent again";
}

TEST_F(PilotTest, WithoutPositionsItSaysZeroAndThenSearches) {
  PilotProcess pilot(tap_.address());
  ASSERT_TRUE(pilot.serve_until([&] { return prepared(); }));
  EXPECT_TRUE(pilot.serve_until([&] {
    const auto told = robot_.wheels.told();
    return std::ranges::any_of(told, [](const Wheels::Speeds& speeds) {
      return speeds.left == -speeds.right && speeds.left != 0.0F;
    });
  }));
  EXPECT_EQ(robot_.wheels.told().front().left, 0.0F);
}

TEST_F(PilotTest, AStopGoesBeforePositions) {
  PilotProcess pilot(tap_.address());
  ASSERT_TRUE(pilot.serve_until([&] { return prepared(); }));
  robot_.eye.raise(::rover::ObjectPositionEvent{160, 120});
  ASSERT_TRUE(pilot.serve_until(
      [&] { return count(ride::Type::kEvent, false, number_of_vs("ObjectPositionEvent")) > 0; }));
  ASSERT_TRUE(pilot.application().call("Halt", "press", {}));
  ASSERT_TRUE(pilot.serve_until([&] { return robot_.eye.stopped_ > 0; }));
  std::uint32_t stop = 0;
  std::uint32_t positions = 0;
  std::size_t seen = 0;
  for (const Passed& each : tap_.passed()) {
    if (each.to_robot && each.first == number_of_vs("void stop(")) stop = each.header.priority;
    if (each.first != number_of_vs("ObjectPositionEvent") || each.to_robot) continue;
    positions = std::max(positions, each.header.priority);
    ++seen;
  }
  EXPECT_GE(seen, 1U);
  EXPECT_EQ(stop, 200U);
  EXPECT_LT(positions, stop);
}

TEST_F(PilotTest, ACommandOfAPlaceholderDoesNotWait) {
  ride::Node node;
  ride::Peer& peer = node.connect(tap_.address());
  ::rover::VSPlaceholder vision(peer, "Vision");
  ASSERT_TRUE(peer.wait_until_connected(10s));
  const base::Time end = platform::monotonic_now() + 30s;
  while (robot_.eye.started_ == 0 && platform::monotonic_now() < end) {
    vision.start();
    std::this_thread::sleep_for(1ms);
  }
  EXPECT_GE(robot_.eye.started_, 1);
  EXPECT_GE(count(ride::Type::kCommand, true, number_of_vs("void start(")), 1U);
  EXPECT_EQ(count(ride::Type::kRequest, true, number_of_vs("void start(")), 0U);
}

TEST_F(PilotTest, WhatNobodyHasIsToldByControl) {
  tap_.send_command(4711, number_of_vs("void start("));
  EXPECT_EQ(
      count(ride::Type::kControl, false, static_cast<ride::Number>(ride::Code::kNoSuchComponent)),
      1U);
  EXPECT_EQ(robot_.eye.started_, 0);
}

}  // namespace
}  // namespace armature::rover
