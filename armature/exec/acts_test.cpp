// SPDX-License-Identifier: Apache-2.0
// What is done to an application from outside is told, with its instant and turn.
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/exec/internal/test_components.hpp"

namespace armature::exec {
namespace {

using ::testing::ElementsAre;

class Mover final : public component::Component {
 public:
  using Component::Component;

 private:
  double doubled(double value) { return 2.0 * value; }
  component::Outcome begin_move() { return component::accepted(); }
  void cancel_move() {}

  component::Property<double> gain_{this,     "Gain", 1.0,
                                    "a gain", "",     component::changeable_while_running};
  component::Operation<double(double)> doubled_{this, "doubled", component::serve<&Mover::doubled>,
                                                "doubles"};
  component::Command<> move_{this, "move", component::serve<&Mover::begin_move>, "moves",
                             component::cancelled_by<&Mover::cancel_move>};
};

class Acts : public testing::Test {
 protected:
  void begin(bool simulated = true) {
    Blueprint blueprint;
    blueprint.add<Mover>("Mover", Activity::periodic(10ms));
    ApplicationOptions options;
    options.simulated = simulated;
    options.acts = [this](const Act& act) { acts.push_back(act); };
    options.attend = [this] {
      if (attend) attend();
    };
    application.emplace(std::move(blueprint), std::move(options));
    ASSERT_TRUE(application->start().ok());
  }
  std::vector<Act::Kind> kinds() const {
    std::vector<Act::Kind> all;
    for (const Act& act : acts) all.push_back(act.kind);
    return all;
  }
  std::vector<Act> acts;
  std::function<void()> attend;
  std::optional<Application> application;
};

TEST_F(Acts, AreToldWithTheirInstantTurnAndValues) {
  begin();
  application->run_for(25ms);
  static_cast<void>(
      application->call("Mover", "doubled", {types::Value::of(2.5)}, Caller::kScript));
  ASSERT_EQ(acts.size(), 1u);
  EXPECT_EQ(acts[0].kind, Act::Kind::kCall);
  EXPECT_EQ(acts[0].component + "." + acts[0].item, "Mover.doubled");
  EXPECT_EQ(acts[0].values.at(0).text(), "2.5");
  EXPECT_EQ(acts[0].caller, Caller::kScript);
  EXPECT_EQ(acts[0].time, base::Time{} + 25ms);
  EXPECT_EQ(acts[0].turn, 2u) << "one for each cycle";
  EXPECT_FALSE(acts[0].attended);
}

TEST_F(Acts, ThatWereRefusedAreToldAgain) {
  begin();
  application->run_for(10ms);
  ASSERT_TRUE(application->set_property("Mover", "Gain", types::Value::of(2.0)).ok());
  ASSERT_FALSE(application->set_property("Mover", "Gian", types::Value::of(2.0)).ok());
  ASSERT_FALSE(application->begin("Mover", "fly", {}).ok());
  ASSERT_FALSE(application->start_component("Nobody"));
  ASSERT_EQ(acts.size(), 7u);
  const auto is_refusal = [&](std::size_t i) { return acts[i].kind == Act::Kind::kRefused; };
  EXPECT_FALSE(is_refusal(0) || is_refusal(1));
  EXPECT_TRUE(is_refusal(2) && is_refusal(4) && is_refusal(6));
  EXPECT_EQ(acts[2].number, 2u) << "the second act";
  EXPECT_EQ(acts[4].number, 3u);
  EXPECT_EQ(acts[6].number, 4u);
  EXPECT_THAT(acts[2].item, ::testing::HasSubstr("Gian"));
}

TEST_F(Acts, InRealTimeAreToldAgainWithTheTimeAtWhichTheyWereDone) {
  begin(false);
  static_cast<void>(application->call("Mover", "doubled", {types::Value::of(2.5)}));
  static_cast<void>(application->call("Mover", "halved", {}));
  EXPECT_THAT(kinds(), ElementsAre(Act::Kind::kCall, Act::Kind::kDone, Act::Kind::kCall,
                                   Act::Kind::kRefused));
  EXPECT_EQ(acts.at(1).number, 1u);
  EXPECT_GE(acts.at(1).time, acts.at(0).time);
  EXPECT_LE(acts.at(1).time, application->now());
  EXPECT_EQ(acts.at(3).number, 2u);
}

TEST_F(Acts, OfCommandsHaveNumbersByWhichTheyAreCancelled) {
  begin();
  application->run_for(10ms);
  auto first = application->begin("Mover", "move", {});
  ASSERT_TRUE(first.ok()) << first.error();
  application->run_for(10ms);
  first.value().cancel();
  application->run_for(10ms);
  auto second = application->begin("Mover", "move", {});
  ASSERT_TRUE(second.ok()) << second.error();
  EXPECT_THAT(kinds(), ElementsAre(Act::Kind::kBegin, Act::Kind::kCancel, Act::Kind::kBegin));
  EXPECT_EQ(acts[1].command, acts[0].command);
  EXPECT_EQ(acts[1].time, base::Time{} + 20ms);
  EXPECT_NE(acts[2].command, acts[0].command);
}

TEST_F(Acts, OfToolsThatAreAttendedToSaySo) {
  begin();
  attend = [this] {
    if (application->now() != base::Time{} + 20ms) return;
    static_cast<void>(application->set_property("Mover", "Gain", types::Value::of(3.0)));
  };
  application->run_for(25ms);
  ASSERT_THAT(kinds(), ElementsAre(Act::Kind::kSet));
  EXPECT_TRUE(acts[0].attended);
}

TEST_F(Acts, OfTheEndAreToldOnce) {
  begin();
  application->run_for(10ms);
  application->run_before_stop(RunEnd::kTimeUp);
  application->stop();
  application->stop();
  EXPECT_THAT(kinds(), ElementsAre(Act::Kind::kBeforeStop, Act::Kind::kEnd));
  EXPECT_EQ(acts[0].item, "time_up");
}

TEST_F(Acts, ThatOnlyReadAreNone) {
  begin();
  application->run_for(10ms);
  static_cast<void>(application->value_of("Mover", "Gain"));
  EXPECT_THAT(kinds(), ElementsAre());
}

}  // namespace
}  // namespace armature::exec
