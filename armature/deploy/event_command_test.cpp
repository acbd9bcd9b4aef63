// SPDX-License-Identifier: Apache-2.0
// Events that command (paper 4, section II.B): what they give, what becomes of it, and mistakes.
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/base/seconds.hpp"
#include "armature/deploy/deployment.hpp"
#include "armature/deploy/internal/test_models.hpp"
#include "armature/document/yaml.hpp"
#include "armature/orocos/deployer_file.hpp"
#include "armature/types/struct.hpp"

namespace armature::deploy {
namespace {

using namespace std::chrono_literals;
using component::Outcome;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Raises its events in every tenth update.
class Button final : public component::Component {
 public:
  using Component::Component;

 private:
  void on_update() override {
    height_.write(0.001 * ++updates_);
    if (updates_ % 10 != 0) return;
    pressed_.raise();
    passed_.raise(0.1 * updates_, updates_ % 20 == 0);
    turned_.raise(1.0);
    crossed_.raise(0.1 * updates_, false);
    counted_.raise(updates_ / 10);
    floor_.write(static_cast<std::uint8_t>(updates_ / 10));
  }

  component::Event<> pressed_{this, "Pressed", "by somebody"};
  component::Event<double, bool> passed_{this, "Passed", "a place", {"height [m]", "fast"}};
  component::Event<double> turned_{this, "Turned", "a wheel", {"height [rad]"}};
  component::Event<double, bool> crossed_{this, "Crossed", "a place", {"place [m]", "height"}};
  component::Event<std::int32_t> counted_{this, "Counted", "whole metres", {"height [m]"}};
  component::OutputPort<std::uint8_t> floor_{this, "Floor", "whole metres", "m"};
  component::OutputPort<double> height_{this, "Height", "of somebody", "m"};
  component::OutputPort<double> never_{this, "Never", "is not written", "m"};
  component::OutputPort<double> angle_{this, "Angle", "of somebody", "rad"};
  int updates_ = 0;
};

/// Travels for three updates; refuses what is below 0.
class Lift final : public component::Component {
 public:
  using Component::Component;
  std::vector<double> heights;
  std::vector<bool> fast;
  std::vector<double> began_at;  ///< [s]
  int levelled = 0;

 private:
  Outcome travel(double height, bool quickly) {
    if (height < 0.0) return component::refused("there is nothing below");
    heights.push_back(height);
    fast.push_back(quickly);
    began_at.push_back(base::to_seconds(time() - base::Time{}));
    left_ = 3;
    return component::accepted();
  }
  Outcome pick(std::int32_t) { return component::accepted(); }
  Outcome level() {
    ++levelled;
    levelled_.raise();
    level_.complete();
    return component::accepted();
  }
  Outcome move(double) { return component::accepted(); }
  bool is_there() { return left_ == 0 || --left_ == 0; }
  void stop_now() {}
  void on_update() override {}

  component::Command<double, bool> travel_{this,
                                           "travel",
                                           component::serve<&Lift::travel>,
                                           "goes there",
                                           component::done_when<&Lift::is_there>,
                                           component::args("height [m]", "quickly")};
  component::Command<std::int32_t> pick_{this, "pick", component::serve<&Lift::pick>, "picks",
                                         component::args("floor")};
  component::Command<> level_{this, "level", component::serve<&Lift::level>, "levels the cabin"};
  component::Event<> levelled_{this, "Levelled", "the cabin is level"};
  component::Command<double> move_{this,
                                   "move",
                                   component::serve<&Lift::move>,
                                   "by hand",
                                   component::by_operator,
                                   component::args("height [m]")};
  component::Operation<void()> stop_{this, "stop", component::serve<&Lift::stop_now>, "stops it"};
  component::InputPort<double> load_{this, "Load", "in it", "kg", component::may_stay_open};
  int left_ = 0;
};

/// Tells what comes in.
class Bell final : public component::Component {
 public:
  using Component::Component;

 private:
  void ring(double) { rung_.raise(); }
  component::InputPort<double> in_{this, "In", "rings it", "", component::on_data<&Bell::ring>};
  component::Event<> rung_{this, "Rung", "by somebody"};
};

/// Its command gives a voltage.
class Winch final : public component::Component {
 public:
  using Component::Component;

 private:
  Outcome pull() {
    out_.write(1.0);
    return component::accepted();
  }
  component::Command<> pull_{this, "pull", component::serve<&Winch::pull>, "pulls"};
  component::OutputPort<double> out_{this, "Volts", "for a motor", "V"};
};

struct Push {
  double force = 0.0;
};
ARMATURE_STRUCT(Push, (force, "N"));

/// Drives what has no port: its commands take an effort.
class Motor final : public component::Component {
 public:
  using Component::Component;

 private:
  Outcome turn(double) { return component::accepted(); }
  Outcome push(Push) { return component::accepted(); }
  component::Command<double> turn_{this, "turn", component::serve<&Motor::turn>, "turns",
                                   component::args("torque [N m]")};
  component::Command<Push> push_{this, "push", component::serve<&Motor::push>, "pushes"};
};

constexpr const char* kParts = R"(
components:
  Button: {model: Button, activity: {periodic: 10 ms}}
  Lift: {model: Lift, activity: {periodic: 10 ms}}
)";

Deployment deployment(const std::string& connections, const std::string& parts = kParts) {
  DeploymentOptions options;
  options.cpus = 2;
  options.models = [](component::Registry& models) {
    test::add_models(models);
    models.add<Button>("Button", "is pressed", {});
    models.add<Lift>("Lift", "travels", {});
    models.add<Bell>("Bell", "is rung", {});
    models.add<Winch>("Winch", "pulls", {});
    models.add<Motor>("Motor", "turns", {});
  };
  return parse_deployment(parts + "connections:\n" + connections, "robot.yaml", options);
}

std::string messages(const std::string& connections) {
  return deployment(connections).diagnostics.to_text();
}

/// Runs in simulated time.
class Running {
 public:
  explicit Running(const std::string& connections, const std::string& parts = kParts) {
    Deployment made = deployment(connections, parts);
    EXPECT_TRUE(made.ok()) << made.diagnostics.to_text();
    made.options.simulated = true;
    application_ = std::make_unique<exec::Application>(std::move(made.blueprint), made.options);
    EXPECT_EQ(application_->start().to_text(), "");
  }
  void run_for(base::Duration time) { application_->run_for(time); }
  const Lift& lift(const char* name = "Lift") const {
    return dynamic_cast<const Lift&>(*application_->find(name));
  }
  exec::Application& application() { return *application_; }
  std::string text_of(const char* component, const char* item) {
    return application_->value_of(component, item).value().text();
  }

 private:
  std::unique_ptr<exec::Application> application_;
};

TEST(EventCommand, TakesItsParametersFromTheDeployment) {
  Running robot(
      "  - {on: Button.Pressed, do: Lift.travel, with: {height: 250 cm, quickly: true}}\n");
  robot.run_for(1s);
  EXPECT_EQ(robot.lift().heights, std::vector<double>(10, 2.5));
  EXPECT_EQ(robot.lift().fast, std::vector<bool>(10, true));
  EXPECT_EQ(robot.text_of("Button_Pressed_Lift_travel", "Given"), "10");
}

TEST(EventCommand, TakesItsParametersFromTheEvent) {
  Running by_place("  - Button.Passed -> Lift.travel\n");
  by_place.run_for(300ms);
  EXPECT_THAT(by_place.lift().heights, ElementsAre(1.0, 2.0, 3.0));
  EXPECT_THAT(by_place.lift().fast, ElementsAre(false, true, false));
  Running by_name("  - {on: Button.Passed, do: Lift.travel, with: {quickly: fast}}\n");
  by_name.run_for(300ms);
  EXPECT_EQ(by_name.lift().fast, by_place.lift().fast);
}

TEST(EventCommand, TakesNumbersOfOtherTypesWhereTheyBecomeTheParameters) {
  Running run("  - {on: Button.Counted, do: Lift.travel, with: {quickly: false}}\n");
  run.run_for(200ms);
  EXPECT_THAT(run.lift().heights, ElementsAre(1.0, 2.0));
  Running by_port(
      "  - {on: Button.Pressed, do: Lift.travel, with: {height: Button.Floor, quickly: false}}\n");
  by_port.run_for(300ms);
  EXPECT_THAT(by_port.lift().heights, ElementsAre(1.0, 2.0));
}

TEST(EventCommand, TakesItsParametersFromPortsAsTheyAreThen) {
  Running robot(
      "  - {on: Button.Pressed, do: Lift.travel, with: {height: Button.Height, quickly: no}}\n");
  robot.run_for(300ms);
  EXPECT_THAT(robot.lift().heights, ElementsAre(0.010, 0.020, 0.030));
}

TEST(EventCommand, WithoutAValueOfAPortIsRefusedCountedAndTold) {
  Running robot(
      "  - {on: Button.Pressed, do: Lift.travel, name: Call,"
      " with: {height: Button.Never, quickly: no}}\n"
      "  - Call.Failed -> Lift.level\n");
  robot.run_for(300ms);
  EXPECT_THAT(robot.lift().heights, ElementsAre());
  EXPECT_EQ(robot.text_of("Call", "Refused"), "3");
  EXPECT_EQ(robot.text_of("Call", "Given"), "0");
  EXPECT_EQ(robot.lift().levelled, 3);
}

TEST(EventCommand, WithAValueThatIsTooOldIsRefused) {
  Running robot(
      "  - {on: Button.Pressed, do: Lift.travel, name: Call, max_age: 50 ms,"
      " with: {height: Slow.Height, quickly: no}}\n",
      std::string(kParts) + "  Slow: {model: Button, activity: {periodic: 170 ms}}\n");
  robot.run_for(1s);
  const auto refused = std::stoi(robot.text_of("Call", "Refused"));
  EXPECT_GE(refused, 5);
  EXPECT_EQ(refused + std::stoi(robot.text_of("Call", "Given")), 10);
  EXPECT_GE(robot.lift().heights.size(), 1u);
}

TEST(EventCommand, ThatTheComponentRefusesIsCountedAndTold) {
  Running robot(
      "  - {on: Button.Pressed, do: Lift.travel, name: Call, with: {height: -1 m, quickly: no}}\n"
      "  - Call.Failed -> Lift.level\n");
  robot.run_for(310ms);
  EXPECT_EQ(robot.text_of("Call", "Refused"), "3");
  EXPECT_EQ(robot.lift().levelled, 3);
}

/// Figure 3 of paper 4: initialize, then the next, then the next.
TEST(EventCommand, EndsInAnEventThatBeginsTheNext) {
  Running robot(
      "  - Second.Done -> Other.level\n"  // the order in the file is the user's
      "  - {on: First.Done, do: Other.travel, name: Second, with: {height: 1 m, quickly: no}}\n"
      "  - {on: Button.Pressed, do: Lift.travel, name: First, with: {height: 2 m, quickly: no}}\n",
      std::string(kParts) + "  Other: {model: Lift, activity: {periodic: 10 ms}}\n");
  robot.run_for(390ms);
  ASSERT_EQ(robot.lift().heights.size(), 3u);
  ASSERT_EQ(robot.lift("Other").heights.size(), 3u);
  EXPECT_NEAR(robot.lift("Other").began_at[0], robot.lift().began_at[0] + 0.02, 1e-9);
  EXPECT_GE(robot.lift("Other").levelled, 2);
}

TEST(EventCommand, OfTheSameRunIsTheSame) {
  const char* connections = "  - {on: Button.Passed, do: Lift.travel, with: {quickly: fast}}\n";
  Running first(connections);
  Running second(connections);
  first.run_for(1s);
  for (int i = 0; i < 100; ++i) second.run_for(10ms);
  EXPECT_EQ(first.lift().began_at, second.lift().began_at);
  EXPECT_EQ(first.lift().heights, second.lift().heights);
}

TEST(EventCommand, MayBeInACompositeAndInARange) {
  const std::string parts = R"(
composites:
  Hoist:
    components:
      Button: {model: Button, activity: {periodic: 10 ms}}
      Lift: {model: Lift, activity: {periodic: 10 ms}}
    connections:
      - {on: Button.Pressed, do: Lift.travel, name: Call, with: {height: Button.Height, quickly: no}}
    exports:
      events: {Pressed: Button.Pressed}
      operations: {level: Lift.level}
components:
  H{1..2}: {model: Hoist}
)";
  Running robot("  - H{i}.Pressed -> H{i}.level\n", parts);
  robot.run_for(100ms);
  for (const char* name : {"H1.Lift", "H2.Lift"}) {
    EXPECT_THAT(robot.lift(name).heights, ElementsAre(0.010)) << name;
    EXPECT_EQ(robot.lift(name).levelled, 1) << name;
  }
  EXPECT_EQ(robot.text_of("H2.Call", "Given"), "1");
}

TEST(EventCommand, IsAPartOfTheCompositeThatHasIt) {
  const std::string parts = R"(
composites:
  Hoist:
    components:
      Button: {model: Button, activity: {periodic: 10 ms}}
      Lift: {model: Lift, activity: {periodic: 10 ms}}
    connections:
      - {on: Button.Pressed, do: Lift.travel, name: Call, with: {height: -1 m, quickly: no}}
      - Call.Failed -> Lift.level
    exports:
      events: {Broken: Call.Failed}
components:
  Hoist: {model: Hoist}
  Button: {model: Button, activity: {periodic: 10 ms}}
  Lift: {model: Lift, activity: {periodic: 10 ms}}
)";
  Running robot(
      "  - {on: Button.Pressed, do: Lift.travel, name: Call, with: {height: 1 m, quickly: no}}\n"
      "  - Hoist.Broken -> Lift.level\n",
      parts);
  robot.run_for(150ms);
  EXPECT_EQ(robot.lift("Hoist.Lift").levelled, 1) << "its own Call, not that beside it";
  EXPECT_EQ(robot.lift("Lift").levelled, 1);
}

TEST(EventCommand, GoesByPlaceWhereTheNamesDoNotFit) {
  Running robot("  - Button.Crossed -> Lift.travel\n");
  robot.run_for(100ms);
  EXPECT_THAT(robot.lift().heights, ElementsAre(1.0)) << "not the one that is called height";
}

TEST(EventCommand, SaysNothingWhileItIsStoppedNorOfWhatItGaveBefore) {
  Running robot(
      "  - {on: Button.Pressed, do: Lift.travel, name: Call, with: {height: 1 m, quickly: no}}\n"
      "  - Call.Done -> Lift.level\n");
  robot.run_for(105ms);
  ASSERT_EQ(robot.lift().heights.size(), 1u);
  ASSERT_TRUE(robot.application().stop_component("Call"));
  ASSERT_TRUE(robot.application().start_component("Call"));
  robot.run_for(90ms);
  EXPECT_EQ(robot.lift().levelled, 0) << "what was given before the stop";
  robot.run_for(100ms);
  EXPECT_EQ(robot.lift().heights.size(), 2u);
  EXPECT_EQ(robot.lift().levelled, 1);
}

TEST(EventCommand, RestsBeforeTheStopAndIsCancelled) {
  Running robot(
      "  - {on: Button.Pressed, do: Lift.travel, name: Call, with: {height: 1 m, quickly: no}}\n"
      "  - {on: Call.Failed, do: Lift.travel, with: {height: 1 m, quickly: no}}\n");
  robot.run_for(105ms);
  ASSERT_EQ(robot.lift().heights.size(), 1u);
  robot.application().run_before_stop(exec::RunEnd::kConditionMet);
  robot.run_for(500ms);
  EXPECT_EQ(robot.lift().heights.size(), 1u);
  EXPECT_EQ(robot.text_of("Call", "Failures"), "1") << "cancelled";
  EXPECT_GE(std::stoi(robot.text_of("Call", "Refused")), 4);
}

TEST(EventCommand, ThatSetsItselfOffWithoutEndIsAFault) {
  Running robot("  - Lift.Levelled -> Lift.level\n  - Button.Pressed -> Lift.level\n");
  robot.run_for(300ms);
  EXPECT_EQ(robot.application().find("Lift_Levelled_Lift_level")->state(),
            component::State::kException);
}

TEST(EventCommand, CanBeRemovedByItsName) {
  const std::string first =
      "  - {on: Button.Pressed, do: Lift.travel, name: Call, with: {height: 1 m, quickly: no}}\n";
  EXPECT_EQ(deployment(first + "  - {name: Call, remove: true}\n").document.connections.size(), 0u);
}

TEST(EventCommand, MayBeGivenTwiceWithDifferentNamesOnly) {
  const std::string one = "{on: Button.Passed, do: Lift.travel, name: One}";
  const std::string two = "{on: Button.Passed, do: Lift.travel, name: Two}";
  EXPECT_EQ(messages("  - " + one + "\n  - " + two + "\n"), "");
  EXPECT_THAT(messages("  - " + one + "\n  - " + one + "\n"),
              HasSubstr("'One' is already the name of a component"));
}

TEST(EventCommand, SwitchesModes) {
  Running robot("  - {on: Button.Pressed, do: Modes.switch, with: {mode: second}}\n", R"(
modes: {first: [Lift], second: [Other]}
components:
  Button: {model: Button, activity: {periodic: 10 ms}}
  Lift: {model: Lift, activity: {periodic: 10 ms, thread: lifts}}
  Other: {model: Lift, activity: {periodic: 10 ms, thread: lifts}}
)");
  robot.run_for(150ms);
  EXPECT_EQ(robot.application().find("Other")->state(), component::State::kRunning);
  EXPECT_EQ(robot.application().find("Lift")->state(), component::State::kStopped);
}

TEST(EventCommand, HasNoFormInOrocosFiles) {
  const Deployment made =
      deployment("  - {on: Button.Pressed, do: Lift.travel, with: {height: 1 m, quickly: no}}\n");
  base::Diagnostics diagnostics;
  orocos::write_xml(made.document, diagnostics);
  EXPECT_THAT(diagnostics.to_text(), HasSubstr("gives a command, which OROCOS files do not have"));
}

TEST(EventCommand, ReadsBackAsItWasWritten) {
  const std::string written =
      "  - {on: Button.Pressed, do: Lift.travel, name: Call, with: {height: Button.Height, "
      "quickly: no}, "
      "max_age: 50 ms}\n  - Button.Passed -> Lift.travel\n";
  const Deployment first = deployment(written);
  ASSERT_TRUE(first.ok()) << first.diagnostics.to_text();
  const std::string text = document::write_yaml(first.document);
  EXPECT_THAT(text, HasSubstr("do: Lift.travel"));
  base::Diagnostics diagnostics;
  const std::size_t begin = text.find("connections:\n");
  const Deployment second = deployment(text.substr(begin + std::string("connections:\n").size()));
  EXPECT_EQ(document::write_yaml(second.document), text);
}

TEST(EventCommand, IsNoWayFromTheOperatorToAnEffort) {
  const std::string parts =
      "operator_inputs: [Bell.In]\ncomponents: {Bell: {model: Bell}, "
      "Winch: {model: Winch, activity: {periodic: 10 ms}}}\n";
  EXPECT_THAT(deployment("  - Bell.Rung -> Winch.pull\n", parts).diagnostics.to_text(),
              HasSubstr("error: 'Bell.In' leads to 'Winch.Volts' by 'Bell', "
                        "'Bell_Rung_Winch_pull'"));
}

TEST(EventCommand, WithAnEffortAsItsParameterIsNoWayFromTheOperator) {
  const std::string parts =
      "operator_inputs: [Bell.In]\ncomponents: {Bell: {model: Bell}, "
      "Motor: {model: Motor, activity: {periodic: 10 ms}}}\n";
  const std::string turns = "  - {on: Bell.Rung, do: Motor.turn, with: {torque: 1 N m}}\n";
  EXPECT_THAT(deployment(turns, parts).diagnostics.to_text(),
              HasSubstr("error: 'Bell.In' leads to 'Motor.turn' by 'Bell', "
                        "'Bell_Rung_Motor_turn'"));
}

struct Mistake {
  const char* connections;
  const char* text;
};

class WrongEventCommand : public ::testing::TestWithParam<Mistake> {};

TEST_P(WrongEventCommand, IsToldAtItsPlace) {
  const std::string told = messages(std::string("  - ") + GetParam().connections + "\n");
  EXPECT_THAT(told, AllOf(HasSubstr("robot.yaml:6:"), HasSubstr(GetParam().text)));
}

INSTANTIATE_TEST_SUITE_P(
    Each, WrongEventCommand,
    ::testing::Values(
        Mistake{"Button.Pressed -> Lift.trave",
                "'Lift' has no command 'trave' (did you mean 'travel'?)"},
        Mistake{"Button.Pressed -> Lyft.travel", "unknown component 'Lyft' (did you mean 'Lift'?)"},
        Mistake{"Button.Presssed -> Lift.travel", "'Button' has no output port 'Presssed'"},
        Mistake{"Button.Pressed -> Lift.travel",
                "nothing gives the parameter 'height' of 'Lift.travel' (say where it comes from: "
                "with: {height: a value, Component.Port or a member of the event})"},
        Mistake{
            "{on: Button.Turned, do: Lift.pick, with: {floor: height}}",
            "'height' of 'Button.Turned' is double in 'rad', but 'floor' of 'Lift.pick' is int"},
        Mistake{"Button.Turned -> Lift.move",
                "'Lift.move' is an act of the operator: no event does it"},
        Mistake{"Button.Pressed -> Lift.Load", "'Lift.Load' is an input port"},
        Mistake{"Button.Pressed -> Lift.stop", "'Lift.stop' is an operation"},
        Mistake{"{on: Button.Pressed, do: Lift.travel, with: {heigth: 1, quickly: no}}",
                "'Lift.travel' has no parameter 'heigth' (did you mean 'height'?)"},
        Mistake{"{on: Button.Turned, do: Lift.travel, with: {quickly: no}}",
                "'height' of 'Button.Turned' is double in 'rad', but 'height' of 'Lift.travel' is "
                "double in 'm'"},
        Mistake{
            "{on: Button.Pressed, do: Lift.travel, with: {height: Button.Angle, quickly: no}}",
            "'Button.Angle' is double in 'rad', but 'height' of 'Lift.travel' is double in 'm'"},
        Mistake{"{on: Button.Pressed, do: Lift.travel, with: {height: Button.Hight, quickly: no}}",
                "'Button' has no output port 'Hight' (did you mean 'Height'?)"},
        Mistake{"{on: Button.Pressed, do: Lift.travel, with: {height: 1 V, quickly: no}}",
                "parameter 'height' of 'Lift.travel'"},
        Mistake{"{on: Button.Passed, do: Lift.travel, max_age: 1 s}",
                "max_age has no effect: no parameter of 'Lift.travel' comes from a port"},
        Mistake{"{on: Button.Passed, do: Lift.travel, policy: {fifo: 3}}",
                "an event that commands has no other policy than max_age"},
        Mistake{"{on: Button.Passed, do: Lift.travel, name: Lift}",
                "'Lift' is already the name of a component"},
        Mistake{"{on: Button.Passed, do: Lift.travel, name: 7 up}", "name must be a name"},
        Mistake{"{on: Button.Passed, do: Lift.travel, with: 3}", "with must be a map"},
        Mistake{"{from: Button.Height, to: Lift.Load, with: {a: 1}}",
                "'Button.Height' is no event, and only an event that commands has parameters"}));

}  // namespace
}  // namespace armature::deploy
