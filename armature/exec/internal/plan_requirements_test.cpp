// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/exec/internal/test_components.hpp"

namespace armature::exec {
namespace {

using namespace component;

class Axis final : public Component {
 public:
  using Component::Component;
  Property<bool> measures{this, "Measures", true, "has a sensor"};
  Operation<double()> read{this, "read", serve<&Axis::do_read>, "the position", only_if(measures)};
  Operation<double()> read_again{this, "readAgain", serve<&Axis::do_read>, "the position"};
  Command<double> move{this, "moveTo", serve<&Axis::do_move>, "goes there"};
  Event<double> arrived{this, "arrived", "it is there"};
  Event<int> stalled{this, "stalled", "it cannot move"};

 private:
  double do_read() { return 1.0; }
  Outcome do_move(double) { return accepted(); }
};

class User final : public Component {
 public:
  using Component::Component;
  Property<std::string> peer{this, "PeerName", "", "who serves read"};
  Property<bool> moves{this, "Moves", false, "uses moveTo"};
  OperationCaller<double()> read{this, "read", "the position", from(peer)};
  CommandCaller<double> move{this, "moveTo", "sends it there", only_if(moves)};
  EventHandler<double> arrived{this, "arrived", serve<&User::on_arrived>, "it is there", optional};

 private:
  void on_arrived(const double&) {}
};

class WrongUser final : public Component {
 public:
  using Component::Component;
  OperationCaller<int(double)> read{this, "read", "with another signature"};
  EventHandler<double> stalled{this, "stalled", serve<&WrongUser::on_stalled>, "so too"};
  CommandCaller<> plain{this, "readAgain", "an operation, not a command", optional};
  OperationCaller<void(double)> command{this, "moveTo", "a command, not an operation", optional};

 private:
  void on_stalled(const double&) {}
};

/// Two axes and a user who knows one.
Blueprint make_blueprint() {
  Blueprint blueprint;
  blueprint.add<User>("User");
  blueprint.add<Axis>("Axis1");
  blueprint.add<Axis>("Axis2");
  return blueprint;
}

User& user_of(Blueprint& blueprint) {
  return static_cast<User&>(*blueprint.components[0].component);
}

void bind(Blueprint& blueprint, std::string requirement, std::string peer,
          std::string member = {}) {
  blueprint.components[0].bindings.push_back(
      {std::move(requirement), std::move(peer), std::move(member), {"robot.yaml", 7, 9}});
}

TEST(PlanRequirements, TheOnePeerThatHasItServes) {
  Blueprint blueprint = make_blueprint();
  blueprint.add_peer("User", "Axis2");
  base::Diagnostics diagnostics;
  const Plan plan = make_plan(blueprint, diagnostics);
  EXPECT_EQ(diagnostics.to_text(), "");
  ASSERT_EQ(plan.calls.size(), 1u);
  EXPECT_EQ(plan.calls[0].caller, 0u);
  EXPECT_EQ(plan.calls[0].callee, 2u);
  EXPECT_EQ(plan.calls[0].operation->name(), "read");
  ASSERT_EQ(plan.subscriptions.size(), 1u);
  EXPECT_EQ(plan.subscriptions[0].from, 2u);
  EXPECT_EQ(plan.subscriptions[0].to, 0u);
}

class Follower final : public Component {
 public:
  using Component::Component;
  Operation<void(const std::vector<double>&)> follow{this, "follow", serve<&Follower::do_follow>,
                                                     "follows", args("path [rad]")};

 private:
  void do_follow(const std::vector<double>&) {}
};

class LeaderByValue final : public Component {
 public:
  using Component::Component;
  OperationCaller<void(std::vector<double>)> follow{this, "follow", "leads"};
};

TEST(PlanRequirements, WhoCallsTakesTheArgumentsAsWhoServesDoes) {
  Blueprint blueprint;
  blueprint.add<LeaderByValue>("Leader");
  blueprint.add<Follower>("Follower");
  blueprint.add_peer("Leader", "Follower");
  EXPECT_EQ(problems_of(std::move(blueprint)),
            "error: 'Leader' uses 'follow' as void(vector<double>), but 'Follower.follow' is "
            "void(const vector<double>& path [rad])\n");
}

TEST(PlanRequirements, WithoutAPeerItSaysWhoCouldServe) {
  EXPECT_EQ(problems_of(make_blueprint()),
            "error: 'User' uses 'read': no peer has this operation (add a peer that has it, for "
            "example 'Axis1')\n");
}

/// Another peer that has it serves in its place.
TEST(PlanRequirements, APeerServesOnlyWhatItOffers) {
  for (const bool has_another : {false, true}) {
    Blueprint blueprint = make_blueprint();
    blueprint.add_peer("User", "Axis1");
    if (has_another) {
      blueprint.add_peer("User", "Axis2");
      bind(blueprint, "arrived", "Axis1");
    }
    auto& first = static_cast<Axis&>(*blueprint.components[1].component);
    first.measures.assign(false);
    base::Diagnostics diagnostics;
    const Plan plan = make_plan(blueprint, diagnostics);
    if (has_another) {
      EXPECT_EQ(diagnostics.to_text(), "");
      ASSERT_EQ(plan.calls.size(), 1u);
      EXPECT_EQ(plan.calls.front().operation->owner().name(), "Axis2");
    } else {
      EXPECT_EQ(diagnostics.to_text(),
                "error: 'User' uses 'read': 'Axis1' has no operation 'read': its property Measures "
                "is false\n");
    }
  }
}

TEST(PlanRequirements, IfNobodyCouldServeItSaysThat) {
  Blueprint blueprint;
  blueprint.add<User>("User");
  EXPECT_EQ(problems_of(blueprint),
            "error: 'User' uses 'read': no peer has this operation (no component of the deployment "
            "has it)\n");
}

TEST(PlanRequirements, SeveralPeersThatHaveItAreAmbiguous) {
  Blueprint blueprint = make_blueprint();
  blueprint.add_peer("User", "Axis1");
  blueprint.add_peer("User", "Axis2");
  EXPECT_EQ(problems_of(blueprint),
            "error: 'User' uses 'read': several peers have this operation: 'Axis1', 'Axis2' "
            "(choose one: bind: {read: Axis1})\n"
            "error: 'User' uses 'arrived': several peers have this event: 'Axis1', 'Axis2' (choose "
            "one: bind: {arrived: Axis1})\n");
}

TEST(PlanRequirements, ABindingSaysWhichAndUnderWhichName) {
  Blueprint blueprint = make_blueprint();
  blueprint.add_peer("User", "Axis1");
  blueprint.add_peer("User", "Axis2");
  bind(blueprint, "read", "Axis2", "readAgain");
  bind(blueprint, "arrived", "Axis1");
  base::Diagnostics diagnostics;
  const Plan plan = make_plan(blueprint, diagnostics);
  EXPECT_EQ(diagnostics.to_text(), "");
  ASSERT_EQ(plan.calls.size(), 1u);
  EXPECT_EQ(plan.calls[0].operation->owner().name(), "Axis2");
  EXPECT_EQ(plan.calls[0].operation->name(), "readAgain");
  ASSERT_EQ(plan.subscriptions.size(), 1u);
  EXPECT_EQ(plan.subscriptions[0].event->owner().name(), "Axis1");
}

TEST(PlanRequirements, ABindingOfWhatIsNotRequiredIsAMistake) {
  Blueprint blueprint = make_blueprint();
  blueprint.add_peer("User", "Axis1");
  bind(blueprint, "raed", "Axis1");
  EXPECT_EQ(problems_of(blueprint),
            "robot.yaml:7:9: error: 'User' requires no operation or event 'raed' (did you mean "
            "'read'?)\n");
}

TEST(PlanRequirements, ABindingNamesAPeer) {
  Blueprint blueprint = make_blueprint();
  blueprint.add_peer("User", "Axis1");
  bind(blueprint, "read", "Axis2");
  EXPECT_EQ(problems_of(blueprint),
            "robot.yaml:7:9: error: 'Axis2' is not a peer of 'User' (add it to the peers of "
            "'User')\n");
}

TEST(PlanRequirements, ABindingNamesSomethingThatThePeerHas) {
  Blueprint blueprint = make_blueprint();
  blueprint.add_peer("User", "Axis1");
  bind(blueprint, "read", "Axis1", "reed");
  bind(blueprint, "arrived", "Axis1", "stoped");
  EXPECT_EQ(problems_of(blueprint),
            "robot.yaml:7:9: error: 'Axis1' has no operation 'reed' (did you mean 'read'?)\n"
            "robot.yaml:7:9: error: 'Axis1' has no event 'stoped' (known: arrived, stalled)\n");
}

TEST(PlanRequirements, AnUnknownPeerIsNamedWithTheNearest) {
  Blueprint blueprint = make_blueprint();
  blueprint.components[0].peers.push_back({"Axis1", {}});
  blueprint.components[0].peers.push_back({"Axsi2", {"robot.yaml", 4, 20}});
  EXPECT_EQ(problems_of(blueprint),
            "robot.yaml:4:20: error: 'User' has the unknown peer 'Axsi2' "
            "(did you mean 'Axis2'?)\n");
}

TEST(PlanRequirements, WhatAnUnknownPeerWouldServeIsNotReportedToo) {
  const std::string problem =
      "error: 'User' has the unknown peer 'Axsi2' (did you mean "
      "'Axis2'?)\n";
  Blueprint blueprint = make_blueprint();
  blueprint.add_peer("User", "Axsi2");
  EXPECT_EQ(problems_of(blueprint), problem);
  ASSERT_TRUE(user_of(blueprint).peer.set(types::Value::of(std::string("Axis2"))));
  EXPECT_EQ(problems_of(blueprint), problem);
  for (const char* peer : {"Axis2", "Axsi2"}) {
    Blueprint bound = make_blueprint();
    bound.add_peer("User", "Axsi2");
    bind(bound, "read", peer);
    EXPECT_EQ(problems_of(bound), problem);
  }
}

TEST(PlanRequirements, APropertyMayDemandAPeer) {
  Blueprint blueprint = make_blueprint();
  ASSERT_TRUE(user_of(blueprint).peer.set(types::Value::of(std::string("Axis2"))));
  blueprint.add_peer("User", "Axis1");
  EXPECT_EQ(problems_of(blueprint),
            "error: 'User' uses 'read' of 'Axis2', which is not among its peers (add it: "
            "peers: [Axis2])\n");
  blueprint.components[0].peers[0].name = "Axis2";
  base::Diagnostics diagnostics;
  const Plan plan = make_plan(blueprint, diagnostics);
  EXPECT_EQ(diagnostics.to_text(), "");
  EXPECT_EQ(plan.calls.at(0).operation->owner().name(), "Axis2");
}

TEST(PlanRequirements, WhatAPropertySwitchesOffIsNotRequired) {
  Blueprint blueprint = make_blueprint();
  blueprint.add_peer("User", "Axis1");
  EXPECT_EQ(problems_of(blueprint), "");
  ASSERT_TRUE(user_of(blueprint).moves.set(types::Value::of(true)));
  base::Diagnostics diagnostics;
  EXPECT_EQ(make_plan(blueprint, diagnostics).calls.size(), 2u) << diagnostics.to_text();
}

TEST(PlanRequirements, WhatAPeerThatCouldNotBeMadeMightServeIsNotReported) {
  Blueprint blueprint;
  blueprint.add<User>("User");
  blueprint.components[0].peers.push_back({"Axis", {}});
  blueprint.absent.insert("Axis");
  EXPECT_EQ(problems_of(blueprint), "");
}

/// A relation of one direction: what B offers is for A, what A offers is not for B (paper 1,
/// section 2).
TEST(PlanRequirements, ThePeerOfAUserUsesNothingOfThatUserItself) {
  Blueprint blueprint;
  blueprint.add<User>("User");
  blueprint.add<Axis>("Axis1");
  blueprint.add_peer("Axis1", "User");
  EXPECT_EQ(problems_of(blueprint),
            "error: 'User' uses 'read': no peer has this operation (add a peer that has it, for "
            "example 'Axis1')\n");
}

/// Paper 4, section II.A: each component relies on its subordinates alone.
TEST(PlanRequirements, ASubordinateThatUsesItsSuperiorIsRefused) {
  Blueprint blueprint;
  blueprint.add<User>("User");
  blueprint.add<Axis>("Axis1");
  blueprint.add_peer("User", "Axis1");
  EXPECT_EQ(problems_of(blueprint), "");
  blueprint.add_peer("Axis1", "User");
  EXPECT_EQ(problems_of(blueprint),
            "error: 'Axis1' uses 'User', which uses it: peers form a circle, 'User' -> 'Axis1' -> "
            "'User' (if that is meant, list the one that commands: superiors: [User])\n");
  blueprint.components[1].peers.front().superior = true;
  EXPECT_EQ(problems_of(blueprint), "") << "it is declared";
}

TEST(PlanRequirements, ACircleOfSubordinatesIsToldWithItsWay) {
  Blueprint blueprint;
  for (const char* name : {"A", "B", "C", "Other"}) blueprint.add<Axis>(name);
  blueprint.add_peer("Other", "B");
  blueprint.add_peer("A", "B");
  blueprint.add_peer("A", "C");
  blueprint.add_peer("B", "C");
  EXPECT_EQ(problems_of(blueprint), "") << "two ways down to one subordinate are no circle";
  blueprint.add_peer("C", "A");
  EXPECT_THAT(problems_of(blueprint), ::testing::HasSubstr("'A' -> 'B' -> 'C' -> 'A'"));
}

TEST(PlanRequirements, SignaturesMustMatch) {
  Blueprint blueprint;
  blueprint.add<WrongUser>("User");
  blueprint.add<Axis>("Axis");
  blueprint.add_peer("User", "Axis");
  EXPECT_EQ(problems_of(blueprint),
            "error: 'User' uses 'read' as int32(double), but 'Axis.read' is double()\n"
            "error: 'User' uses 'readAgain' as void() (a command), but 'Axis.readAgain' is "
            "double()\n"
            "error: 'User' uses 'moveTo' as void(double), but 'Axis.moveTo' is void(double) (a "
            "command)\n"
            "error: 'User' uses 'stalled' as void(double), but the event 'Axis.stalled' is "
            "void(int32)\n");
}

}  // namespace
}  // namespace armature::exec
