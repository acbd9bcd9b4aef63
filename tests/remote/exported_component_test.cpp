// SPDX-License-Identifier: Apache-2.0
// What a peer gets that is no application of ours.
#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/interface.hpp"
#include "armature/remote/interface_numbers.hpp"
#include "armature/remote/link_to.hpp"
#include "armature/ride/node.hpp"
#include "tests/remote/processes.hpp"

namespace armature::remote {
namespace {

using namespace test;
using testing::HasSubstr;

struct Peer {
  explicit Peer(const std::string& address, const ride::Interface& interface)
      : link(node.connect(address), "Axis", interface) {}
  /// The answer to a request while `robot` serves.
  ride::Code ask(Process& robot, ride::Number number, const ride::Fields& fields,
                 std::string* text = nullptr) {
    struct Answer {
      std::atomic<bool> came{false};
      ride::Code code{};
      std::string text;
    };
    const auto answer = std::make_shared<Answer>();
    link.ask(number, {}, fields, [answer](ride::Code code, std::string_view why, auto) {
      answer->code = code;
      answer->text = why;
      answer->came = true;
    });
    EXPECT_TRUE(serve_until({&robot}, [&] { return answer->came.load(); }));
    if (text != nullptr) *text = answer->text;
    return answer->code;
  }
  ride::Node node;
  LinkTo link;
};

struct RemotePeer : testing::Test {
  void start(const std::string& yaml) {
    robot = std::make_unique<Process>(yaml);
    robot->start();
    peer = std::make_unique<Peer>(robot->address(), numbers.interface());
    ASSERT_TRUE(peer->link.peer().wait_until_connected(10s));
  }
  const Axis axis{"Axis"};
  const InterfaceNumbers numbers{"Axis", component::interface_of(axis)};
  std::unique_ptr<Process> robot;
  std::unique_ptr<Peer> peer;
  const std::tuple<> nothing;
};

TEST_F(RemotePeer, AnActOfTheOperatorNeedsAGrant) {
  start(server());
  std::string text;
  EXPECT_EQ(peer->ask(*robot, ride::number_of("void arm()"), ride::Fields(nothing), &text),
            ride::Code::kFailed);
  EXPECT_THAT(text, HasSubstr("grants: {remote: [Axis.arm]}"));
  EXPECT_EQ(*robot->application->call("Axis", "armed", {}).value()->get_if<int>(), 0);
  peer.reset();
  start(server() + "grants: {remote: [Axis.arm]}\n");
  EXPECT_EQ(peer->ask(*robot, ride::number_of("void arm()"), ride::Fields(nothing)),
            ride::Code::kNone);
  EXPECT_EQ(*robot->application->call("Axis", "armed", {}).value()->get_if<int>(), 1);
}

TEST_F(RemotePeer, WithoutAPolicyNothingButLookingIsAllowed) {
  start(
      "network: {listen: 'tcp://127.0.0.1:0'}\n"
      "components: {Axis: {model: Axis, activity: {periodic: 2 ms}}}\n");
  EXPECT_EQ(peer->ask(*robot, ride::number_of("int armed()"), ride::Fields(nothing)),
            ride::Code::kNotAllowed);
  std::atomic<int> samples{0};
  const ride::Subscription subscription =
      peer->link.subscribe(numbers.number(NumberedMember::Kind::kOutput, 0), [&](ride::Decoder&) {
        ++samples;
        return true;
      });
  EXPECT_TRUE(serve_until({robot.get()}, [&] { return samples > 3; }));
}

TEST_F(RemotePeer, WhatFailsThereIsToldHere) {
  start(server());
  std::string text;
  const std::tuple one{1};
  EXPECT_EQ(peer->ask(*robot, ride::number_of("int fail(int)"), ride::Fields(one), &text),
            ride::Code::kFailed);
  EXPECT_THAT(text, HasSubstr("it broke"));
  EXPECT_EQ(peer->ask(*robot, ride::number_of("int fail(int)"), ride::Fields(nothing)),
            ride::Code::kMalformed);
  EXPECT_EQ(peer->ask(*robot, ride::number_of("int fell(int)"), ride::Fields(one)),
            ride::Code::kNoSuchOperation);
}

/// Who moves something is there to stop it, or it stops.
TEST_F(RemotePeer, ACommandIsCancelledWithTheConnectionThatBeganItAndWithNoOther) {
  start(server());
  Peer watcher(robot->address(), numbers.interface());
  ASSERT_TRUE(watcher.link.peer().wait_until_connected(10s));
  const auto travels = [&] {
    auto& moving = robot->find<Axis>("Axis");
    const auto& operations = component::interface_of(moving).operations;
    const auto travel = std::ranges::find_if(
        operations, [](const component::OperationBase* one) { return one->name() == "travel"; });
    bool active = false;
    EXPECT_TRUE(robot->application->run_in_thread_of(
        moving, [&] { active = static_cast<const component::CommandBase*>(*travel)->active(); }));
    return active;
  };
  const std::tuple endless{2.5};
  for (const bool with_answer : {true, false}) {
    const ride::Number travel = ride::number_of("void travel(double)");
    if (with_answer) {
      peer->link.ask(travel, {}, ride::Fields(endless), [](auto, auto, auto) {});
    } else {
      EXPECT_TRUE(serve_until({robot.get()}, [&] {  // the component is looked up first
        return peer->link.send(travel, {}, ride::Fields(endless)) == ride::Sent::kYes;
      }));
    }
    EXPECT_TRUE(serve_until({robot.get()}, travels));
    EXPECT_EQ(watcher.ask(*robot, ride::number_of("int armed()"), ride::Fields(nothing)),
              ride::Code::kNone);
    {
      Peer another(robot->address(), numbers.interface());
      EXPECT_TRUE(another.link.peer().wait_until_connected(10s));
    }
    for (int i = 0; i < 100; ++i) robot->serve();
    EXPECT_TRUE(travels());
    robot->log.clear();
    peer.reset();
    EXPECT_TRUE(serve_until({robot.get()}, [&] { return !travels(); }));
    EXPECT_TRUE(serve_until({robot.get()},
                            [&] { return robot->log.find("is cancelled") != std::string::npos; }));
    EXPECT_THAT(
        robot->log,
        HasSubstr("'Axis.travel' is cancelled: the connection to local, which began it, is lost"));
    peer = std::make_unique<Peer>(robot->address(), numbers.interface());
    ASSERT_TRUE(peer->link.peer().wait_until_connected(10s));
  }
}

/// Each gap in what a port wrote can be seen from the sequence.
TEST_F(RemotePeer, SamplesComeInTheirOrderWithTheirNumber) {
  start(server());
  std::mutex mutex;
  std::vector<std::pair<std::uint64_t, double>> samples;
  const ride::Subscription subscription = peer->link.subscribe(
      numbers.number(NumberedMember::Kind::kOutput, 0), [&](ride::Decoder& members) {
        std::uint64_t sequence = 0;
        std::int64_t time = 0;
        double value = 0.0;
        if (!members.take(sequence) || !members.take(time) || !members.take(value)) return false;
        const std::lock_guard lock(mutex);
        samples.emplace_back(sequence, value);
        return members.ended();
      });
  EXPECT_TRUE(serve_until({robot.get()}, [&] {
    const std::lock_guard lock(mutex);
    return samples.size() > 20;
  }));
  const std::lock_guard lock(mutex);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    EXPECT_EQ(static_cast<double>(samples[i].first), samples[i].second);  // it counts its writes
    if (i > 0) {
      EXPECT_GE(samples[i].first, samples[i - 1].first);
    }
  }
}

}  // namespace
}  // namespace armature::remote
