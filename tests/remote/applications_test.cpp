// SPDX-License-Identifier: Apache-2.0
// Two applications: the components of one are used by the other.
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/interface.hpp"
#include "armature/remote/placeholder.hpp"
#include "armature/testing/kept_port.hpp"
#include "tests/remote/processes.hpp"

namespace armature::remote {
namespace {

using namespace test;
using ::testing::HasSubstr;

struct Remote : ::testing::Test {
  void start() {
    robot = std::make_unique<Process>(server(port.address()));
    robot->start();
    pilot = std::make_unique<Process>(client(port.address()));
    start_pilot();
  }
  /// Its start asks for what the robot's controlling thread answers.
  void start_pilot() {
    pilot->start();
    user = &pilot->find<User>("User");
  }
  bool until(const std::function<bool()>& condition) {
    std::vector<Process*> all{pilot.get()};
    if (robot != nullptr) all.push_back(robot.get());
    return serve_until(all, condition);
  }
  Placeholder& there() const { return pilot->find<Placeholder>("There"); }

  const testing::KeptPort port;
  std::unique_ptr<Process> robot;
  std::unique_ptr<Process> pilot;
  User* user = nullptr;
};

TEST_F(Remote, PortsEventsAndOperationsAreUsedAsIfTheyWereHere) {
  start();
  EXPECT_TRUE(until([&] { return user->position > 20.0 && user->tenths > 2; }));
  EXPECT_TRUE(until([&] { return user->answer == 8.0; }));
  EXPECT_EQ(user->status, component::CallStatus::kDone);
  EXPECT_EQ(there().state(), State::kRunning);
}

TEST_F(Remote, ACommandIsFollowedToItsEnd) {
  start();
  user->target = 1.0;
  EXPECT_TRUE(until([&] { return user->progress > 0.2; }));
  EXPECT_TRUE(until([&] { return user->stage == component::CommandStage::kDone; }));
  user->target = 5.0;
  EXPECT_TRUE(until([&] { return user->stage == component::CommandStage::kFailed; }));
}

TEST_F(Remote, ACommandThatIsCancelledHereEndsThere) {
  start();
  user->target = 2.5;
  EXPECT_TRUE(until([&] { return user->stage == component::CommandStage::kAccepted; }));
  user->cancel = true;
  EXPECT_TRUE(until([&] { return user->stage == component::CommandStage::kCancelled; }));
  user->target = 1.0;  // it could not begin if the one before were under way there
  EXPECT_TRUE(until([&] { return user->stage == component::CommandStage::kDone; }));
}

/// While nobody subscribes nothing is attached, so that others cost a real-time thread nothing.
TEST_F(Remote, WhatNobodyUsesElsewhereIsNotListenedTo) {
  robot = std::make_unique<Process>(server());
  robot->start();
  const auto& position = *component::interface_of(robot->find<Axis>("Axis")).outputs.front();
  EXPECT_FALSE(position.is_tapped());
  pilot = std::make_unique<Process>(client(robot->address()));
  start_pilot();
  EXPECT_TRUE(until([&] { return user->position > 1.0; }));
  EXPECT_TRUE(position.is_tapped());
  pilot.reset();
  EXPECT_TRUE(serve_until({robot.get()}, [&] { return !position.is_tapped(); }));
}

TEST_F(Remote, ALostPeerIsToldAndComesBackByItself) {
  start();
  EXPECT_TRUE(until([&] { return user->position > 5.0; }));
  robot.reset();
  EXPECT_TRUE(until([&] { return there().state() == State::kRunTimeError; }));
  EXPECT_TRUE(until([&] { return user->lost == 1; }));
  EXPECT_TRUE(until([&] { return user->status == component::CallStatus::kUnreachable; }));
  EXPECT_TRUE(until([&] {
    return pilot->log.find("'Axis' at " + port.address() + " cannot be used") != std::string::npos;
  }));
  robot = std::make_unique<Process>(server(port.address()));
  robot->start();
  user->position = 0.0;
  EXPECT_TRUE(until([&] { return there().state() == State::kRunning; }));
  EXPECT_TRUE(until([&] { return user->position > 0.0; }));
  EXPECT_TRUE(until([&] { return user->status == component::CallStatus::kDone; }));
  EXPECT_EQ(user->lost, 1);
}

TEST_F(Remote, ACommandUnderWayFailsWithTheConnection) {
  start();
  user->target = 2.5;
  EXPECT_TRUE(until([&] { return user->stage == component::CommandStage::kAccepted; }));
  robot.reset();
  EXPECT_TRUE(until([&] { return user->stage >= component::CommandStage::kRefused; }));
  EXPECT_NE(user->stage, component::CommandStage::kDone);
}

TEST_F(Remote, APilotMayStartBeforeTheRobot) {
  pilot = std::make_unique<Process>(client(port.address()));
  start_pilot();
  EXPECT_TRUE(until([&] { return there().state() == State::kRunTimeError; }));
  EXPECT_EQ(user->position, 0.0);
  robot = std::make_unique<Process>(server(port.address()));
  robot->start();
  EXPECT_TRUE(until([&] { return user->position > 0.0; }));
}

TEST_F(Remote, OnlyInputsThatTheDeploymentOpensAreWrittenFromElsewhere) {
  robot = std::make_unique<Process>(
      server("tcp://127.0.0.1:0", ", inputs: [{to: Axis.Wish, max_age: 10 s}]"));
  robot->start();
  pilot = std::make_unique<Process>(
      client(robot->address(), ", User.Wish -> There.Wish, User.Wish -> There.Closed"));
  start_pilot();
  user->wish = 0.75;
  const auto& axis = robot->find<Axis>("Axis");
  const auto taken = [&] {
    return *robot->application->value_of("Axis", "Taken").value().get_if<double>();
  };
  EXPECT_TRUE(until([&] { return taken() == 0.75; }));
  EXPECT_EQ(*robot->application->value_of("Axis", "Closed").value().get_if<double>(), 0.0);
  EXPECT_EQ(axis.state(), State::kRunning);
}

TEST_F(Remote, DataOfAPeerThatIsGoneIsTooOldSoon) {
  robot = std::make_unique<Process>(
      server("tcp://127.0.0.1:0", ", inputs: [{to: Axis.Wish, max_age: 2 s}]"));
  robot->start();
  pilot = std::make_unique<Process>(client(robot->address(), ", User.Wish -> There.Wish"));
  start_pilot();
  user->wish = 0.75;
  const auto& axis = robot->find<Axis>("Axis");
  EXPECT_TRUE(until([&] {
    return *robot->application->value_of("Axis", "Taken").value().get_if<double>() == 0.75;
  }));
  EXPECT_EQ(axis.state(), State::kRunning);
  pilot.reset();
  EXPECT_TRUE(serve_until({robot.get()}, [&] { return axis.state() == State::kStopped; }));
}

/// The robot's controlling thread does nothing here: whoever waits for an answer waits in vain.
TEST_F(Remote, APeerThatDoesNotAnswerHoldsUpNoRealTimeThread) {
  robot = std::make_unique<Process>(server());
  robot->start();
  pilot = std::make_unique<Process>(R"(components:
  There: {model: Axis, remote: ')" + robot->address() +
                                    R"(/Axis'}
  Patient: {model: User, activity: {periodic: 5 ms}, peers: [There]}
  Quick: {model: User, activity: {periodic: 1 ms, priority: 10}, peers: [There]}
connections: [There.Position -> Patient.Position, There.Position -> Quick.Position,
              Quick.Wish -> There.Wish]
)");
  pilot->start();
  const User& patient = pilot->find<User>("Patient");
  User& quick = pilot->find<User>("Quick");
  quick.wish = 1.0;
  EXPECT_TRUE(serve_until({pilot.get()}, [&] { return patient.timeouts == 1; }));
  const int before = quick.updates;
  EXPECT_TRUE(serve_until({pilot.get()}, [&] { return patient.timeouts == 2; }));
  EXPECT_GT(quick.updates - before, 100);  // a second is a thousand of its cycles
  EXPECT_EQ(quick.status, component::CallStatus::kWouldWait);
  EXPECT_EQ(quick.timeouts, 0);
}

}  // namespace
}  // namespace armature::remote
