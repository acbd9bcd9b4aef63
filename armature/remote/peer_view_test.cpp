// SPDX-License-Identifier: Apache-2.0
// The two sources of a view are asked the same about one application.
#include "armature/remote/peer_view.hpp"

#include <algorithm>
#include <chrono>
#include <future>
#include <limits>
#include <optional>
#include <ostream>
#include <type_traits>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/inspect/application_view.hpp"
#include "armature/remote/control_queue.hpp"
#include "armature/remote/inspector.hpp"
#include "armature/remote/internal/inspection.hpp"
#include "armature/ride/node.hpp"
#include "armature/testing/small_robot.hpp"

namespace armature::inspect {

/// What differs is told by its parts.
template <typename T>
void PrintTo(const T& value, std::ostream* to) requires requires {
  remote::internal::to_wire(value);
}
{
  const auto wire = remote::internal::to_wire(value);
  *to << types::to_text(types::type_of<std::remove_const_t<decltype(wire)>>(), &wire);
}

}  // namespace armature::inspect

namespace armature::remote {
namespace {

using namespace std::chrono_literals;
using namespace armature::testing::small_robot;
using inspect::CommandStatus;
using inspect::ComponentDescription;
using inspect::ItemValue;
using inspect::LifeCycleChange;
using inspect::Values;
using inspect::View;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// Has one of everything that Axis and Settings have not.
class Witness final : public Component {
 public:
  using Component::Component;

  void say(int number) { log_warning("says {}", number); }

 private:
  void note(int) {}

  Property<int> rows_{this, "Rows", 2, "how many"};
  InputPort<double> place_{this,
                           "Place",
                           "of the axis",
                           "m",
                           on_data_update,
                           max_age(1h, Reaction::kHold),
                           on_lost(Reaction::kHold)};
  InputPort<Stance> stance_{this, "Stance", "of whom it may concern", "", may_stay_open, fan_in};
  OutputPort<std::vector<Gains>> all_{this, "All", "of the axis", "", size_of(rows_)};
  Event<int> seen_{this, "seen", "it saw something", {"steps"}};
  EventHandler<int> own_{this, "own", serve<&Witness::note>, "notes it", optional};
  OperationCaller<double(const std::vector<double>&, double)> sum_{this, "sum", "adds them up"};
  CommandCaller<double> move_{this, "moveTo", "moves the axis", optional};
  OperationTrigger look_{this, "look", "looks"};
  StateMachine mode_{this, "mode", "what it does",
                     in_state("Blind", "sees", on(look_, to("Awake"))), in_state("Awake")};
};

void add_witness(exec::Blueprint& blueprint) {
  blueprint.add<Witness>("Witness", exec::Activity::periodic(10ms));
  blueprint.components.back().model = "Witness";
  blueprint.connect("Axis.Position", "Witness.Place");
  blueprint.add_peer("Witness", "Settings");
}

/// What inspection.idl does not tell, which describe.hpp marks "(here)".
void forget_what_is_not_told(ComponentDescription& description) {
  const auto names_in_doc = [](auto& all) {
    for (auto& one : all) {
      one.doc = inspect::doc_with_values(one.doc, one.values);
      one.values.clear();
    }
  };
  names_in_doc(description.properties);
  names_in_doc(description.inputs);
  names_in_doc(description.outputs);
  names_in_doc(description.fields);
  for (auto& one : description.properties) one.was_set = false;
  for (auto& one : description.inputs) {
    one.sequence = 0;
    one.may_stay_open = one.allows_fan_in = false;
    one.when_lost = Reaction::kStop;
    one.counters = {};
  }
  for (auto& one : description.outputs) {
    one.sequence = 0;
    one.counters = {};
  }
  description.port_arrays.clear();
  for (auto& one : description.operations) one.own_thread = false;
  for (auto& one : description.events) {
    one.raised = 0;
    one.arguments.clear();
  }
  for (auto& one : description.requirements) {
    one.wanted = true;
    one.peer.clear();
    one.not_taken = 0;
  }
  for (auto& one : description.machines) {
    for (auto& state : one.states) state = {state.path, {}, false};
    one.transitions.clear();
    one.triggers.clear();
    one.problems.clear();
  }
}

/// The small robot, whom this thread controls, and its views from here and from another process.
/// Simulated time stands still while they are asked.
class Views : public ::testing::Test {
 protected:
  Views() {
    EXPECT_TRUE(node_.add(Inspector::kName, inspector_.service()).ok());
    ride::Peer& peer = client_.connect(node_.listen("tcp://127.0.0.1:0").value().text());
    there_.emplace(peer);
    EXPECT_TRUE(peer.wait_until_connected(20s).ok());
    pass(100ms);
  }
  ~Views() override {
    there_.reset();
    node_.remove(inspector_.service());
    queue_.close();
  }

  void pass(base::Duration time) { robot_.application().run_for(time); }

  template <typename Question>
  auto here(Question question) {
    return question(static_cast<View&>(here_));
  }
  template <typename Question>
  auto there(Question question) {
    auto answer =
        std::async(std::launch::async, [&] { return question(static_cast<View&>(*there_)); });
    while (answer.wait_for(100us) != std::future_status::ready) queue_.run();
    return answer.get();
  }
  template <typename Question>
  void expect_same(Question question) {
    EXPECT_EQ(there(question), here(question));
  }
  /// That both refuse, with the same text; returns it.
  template <typename Question>
  std::string refusal(Question question) {
    const auto text_of = [&](View& view) -> std::string {
      try {
        question(view);
      } catch (const inspect::Refusal& refused) {
        return refused.what();
      }
      return "is not refused";
    };
    expect_same(text_of);
    return here(text_of);
  }

  SmallRobot robot_{true, {}, add_witness};
  ControlQueue queue_;
  Inspector inspector_{robot_.application(), queue_};
  ride::Node node_;
  ride::Node client_;
  inspect::ApplicationView here_{robot_.application(), exec::Caller::kRemote};
  std::optional<PeerView> there_;
};

TEST_F(Views, AgreeOnTheApplicationAndItsComponents) {
  expect_same([](View& view) { return view.component_names(); });
  expect_same([](View& view) { return view.status(); });
  expect_same([](View& view) { return view.components(); });
  EXPECT_EQ(here([](View& view) { return view.components(); }).size(), 5u);
  const auto two = [](const std::string& name) { return name == "Axis" || name == "aic-1"; };
  expect_same([&](View& view) { return view.components(two); });
}

TEST_F(Views, AgreeOnWhoDoesNotRunAndWhy) {
  EXPECT_TRUE(robot_.application().stop_component("aic-1"));
  robot_.application().run_in_thread_of(robot_.axis(), [&] { robot_.axis().fault("it smokes"); });
  expect_same([](View& view) { return view.faults(); });
  const auto only_axis = [](const std::string& name) { return name == "Axis"; };
  const auto faults = here([&](View& view) { return view.faults(only_axis); });
  ASSERT_EQ(faults.components.size(), 1u);
  EXPECT_EQ(faults.components.front().reason, "it smokes");
  EXPECT_EQ(there([&](View& view) { return view.faults(only_axis); }), faults);
}

TEST_F(Views, AgreeOnWhatLeadsWhere) {
  expect_same([](View& view) { return view.connections(); });
  const auto all = here([](View& view) { return view.connections(); });
  const auto leads = [&](const std::string& kind, const std::string& from, const std::string& to) {
    return std::ranges::any_of(all, [&](const inspect::Connection& one) {
      return one.kind == kind && one.from == from && one.to == to;
    });
  };
  EXPECT_TRUE(leads("data", "Axis.Position", "Witness.Place"));
  EXPECT_TRUE(leads("operation", "Witness.sum", "Settings.sum"));
  const auto without_axis = [](const std::string& name) { return name != "Axis"; };
  const auto rest = [&](View& view) { return view.connections(without_axis); };
  expect_same(rest);
  EXPECT_LT(here(rest).size(), all.size());
  EXPECT_THAT(here(rest), Not(IsEmpty()));
}

TEST_F(Views, TellOnlyOfWiresWhoseEndsTheSenderMayReadBoth) {
  Inspector guarded(robot_.application(), queue_);
  ride::NodeOptions options;
  options.allows = [](const ride::AccessQuestion& asked) { return asked.component != "Axis"; };
  ride::Node node(options);
  ASSERT_TRUE(node.add(Inspector::kName, guarded.service()).ok());
  there_.emplace(client_.connect(node.listen("tcp://127.0.0.1:0").value().text()));
  ASSERT_TRUE(there_->wait_until_connected(20s).ok());
  const auto told = there([](View& view) { return view.connections(); });
  const auto without_axis = [](const std::string& name) { return name != "Axis"; };
  EXPECT_EQ(told, here([&](View& view) { return view.connections(without_axis); }));
  EXPECT_NE(told, here([](View& view) { return view.connections(); }));
  there_.reset();
  node.remove(guarded.service());
}

TEST_F(Views, AgreeOnEveryComponentWithItsValues) {
  for (const std::string& name : here_.component_names()) {
    const auto described = [&](View& view) {
      ComponentDescription description = view.describe(name, Values::kIncluded);
      forget_what_is_not_told(description);
      return description;
    };
    EXPECT_TRUE(here(described).answered);
    expect_same(described);
  }
}

TEST_F(Views, AgreeOnInterfacesWithoutValues) {
  for (const std::string& name : here_.component_names()) {
    expect_same([&](View& view) {
      ComponentDescription description = view.describe(name, Values::kLeftOut);
      forget_what_is_not_told(description);
      // How it stood may be an earlier time's.
      for (auto& one : description.inputs) one.written = false, one.age = {};
      for (auto& one : description.outputs) one.written = false, one.age = {};
      for (auto& one : description.machines) one.current.clear();
      return description;
    });
  }
}

TEST_F(Views, AgreeOnValuesAndOnWhatIsWrongWithOthers) {
  pass(20ms);
  const std::vector<std::string> items{
      "Axis.Position",    "Axis.Both[2]",    "Settings.Gains", "Settings.Gains.kp",
      "Settings.Label",   "Settings.Stance", "Settings.Calls", "Witness.Place",
      "Witness.All",      "Witness.Stance",  "Axis.Both[3]",   "Settings.Offsets[7]",
      "Axxis.Position",   "Settings.Gian",   "Axis:moveTo",    "Witness.seen",
      "left.hand.Finger", "aic-1.Count"};
  const auto read = [&](View& view) { return view.read(items); };
  expect_same(read);
  const std::vector<ItemValue> values = here(read);
  EXPECT_EQ(values.at(1).value + values.at(1).unit + values.at(1).kind, "-0moutput");
  EXPECT_EQ(values.at(9).written, false);
  EXPECT_THAT(values.at(12).error, HasSubstr("did you mean 'Axis'?"));
}

TEST_F(Views, WriteTheSame) {
  expect_same([](View& view) { return view.write("Settings.Gain", "1500 mV/rad"); });
  expect_same([](View& view) { return view.write("Settings.Gains", "{kp: 2, steps: 3}"); });
  expect_same([](View& view) { return view.write("Settings.Stance", "holding"); });
  const auto write = [this](const char* item, const char* value) {
    return refusal([=](View& view) { view.write(item, value); });
  };
  EXPECT_THAT(write("Settings.Count", "11"), HasSubstr("10"));
  EXPECT_THAT(write("Settings.Count", "many"), HasSubstr("Settings.Count: expected"));
  EXPECT_THAT(write("Settings.Gain", "3 m"), HasSubstr("Settings.Gain: "));
  EXPECT_THAT(write("Settings.Fixed", "2"), HasSubstr("stop it first"));
  EXPECT_THAT(write("Axis.Position", "1"), HasSubstr("is a port"));
  EXPECT_THAT(write("Settings.Gains.kp", "1"), HasSubstr("is a part"));
  EXPECT_THAT(write("Setings.Gain", "1"), HasSubstr("unknown component"));
}

TEST_F(Views, CallTheSame) {
  expect_same([](View& view) { return view.call("Settings", "sum", {"[1, 2.5]", "2"}); });
  const auto call = [this](const char* component, const char* operation,
                           const std::vector<std::string>& arguments) {
    return refusal([=](View& view) { view.call(component, operation, arguments); });
  };
  EXPECT_THAT(call("Settings", "sum", {"1"}), HasSubstr("takes 2 arguments, not 1"));
  EXPECT_THAT(call("Settings", "sum", {"1", "2"}), HasSubstr("argument 1 (values [rad])"));
  EXPECT_FALSE(robot_.application().call("Settings", "fail", {}));
  EXPECT_THAT(call("Settings", "fail", {}), HasSubstr("it broke"));
  EXPECT_THAT(call("Settings", "Gain", {}), HasSubstr("neither an operation nor a command"));
  EXPECT_THAT(call("Axis", "arm", {}), HasSubstr("an act of the operator"));
  EXPECT_THAT(call("Axxis", "arm", {}), HasSubstr("unknown component"));
}

TEST_F(Views, TellOfTheirCommandsTheSame) {
  const auto story = [this](auto ask) {
    std::vector<CommandStatus> all;
    const auto begin = [&](const char* target) {
      all.push_back(ask([&](View& view) { return view.begin("Axis", "moveTo", {target}); }));
    };
    const auto follow = [&](base::Duration after) {
      pass(after);
      all.push_back(ask([&](View& view) { return view.follow(all.back().handle); }));
    };
    begin("5");
    follow(20ms);
    follow(100ms);
    begin("1000");
    all.push_back(ask([&](View& view) { return view.cancel(all.back().handle); }));
    follow(20ms);
    begin("30");
    follow(500ms);
    begin("0");
    follow(500ms);  // it is back, so that the next story begins as this one
    return all;
  };
  const std::vector<CommandStatus> expected =
      story([this](auto question) { return here(question); });
  EXPECT_EQ(story([this](auto question) { return there(question); }), expected);
  EXPECT_EQ(expected.at(2).stage, CommandStage::kDone);
  EXPECT_EQ(expected.at(5).stage, CommandStage::kCancelled);
  EXPECT_EQ(expected.at(7).reason, "the axis is stuck");
  EXPECT_THAT(refusal([](View& view) { view.begin("Axis", "moveTo", {"-1"}); }),
              HasSubstr("the target is outside the axis"));
  EXPECT_THAT(refusal([](View& view) { view.follow(77); }), HasSubstr("unknown command handle 77"));
  EXPECT_THAT(refusal([](View& view) { view.cancel(77); }), HasSubstr("unknown command handle 77"));
}

TEST_F(Views, ChangeTheSame) {
  const auto lives = [](View& view) {
    std::vector<inspect::ComponentStatus> all;
    for (const auto change :
         {LifeCycleChange::kStop, LifeCycleChange::kStart, LifeCycleChange::kStop,
          LifeCycleChange::kCleanup, LifeCycleChange::kStart}) {
      all.push_back(view.change("Settings", change));
    }
    return all;
  };
  expect_same(lives);
  EXPECT_EQ(here(lives).at(3).state, State::kPreOperational);
  EXPECT_THAT(refusal([](View& view) { view.change("Axis", LifeCycleChange::kRecover); }),
              HasSubstr("Axis"));
  EXPECT_THAT(refusal([](View& view) { view.change("Axxis", LifeCycleChange::kStop); }),
              HasSubstr("unknown component"));
}

TEST_F(Views, PaceTheSame) {
  const auto paced = [](View& view) {
    return std::vector<exec::Pace>{view.pace(), view.set_pace({0.5, true}), view.step(),
                                   view.set_pace({})};
  };
  expect_same(paced);
  EXPECT_EQ(here(paced).at(1), (exec::Pace{0.5, true}));
  EXPECT_THAT(refusal([](View& view) {
                view.set_pace({-1.0, false});
              }),
              HasSubstr("the pace is a number above 0"));
  EXPECT_THAT(refusal([](View& view) { view.step(); }),
              HasSubstr("only paused simulated time goes on by steps"));
}

TEST_F(Views, WatchTheSame) {
  const auto begin = [](View& view) { return view.watch({"Axis.Position", "Settings"}, 0ms); };
  EXPECT_THAT(refusal(begin), HasSubstr("'Settings' is a component"));
  const auto watch = [](View& view) {
    return view.watch({"Axis.Position", "Settings.Gains", "Witness.Place"}, 0ms);
  };
  const inspect::Watch mine = here(watch);
  const inspect::Watch its = there(watch);
  EXPECT_EQ(mine.items, its.items);
  EXPECT_EQ(mine.items.at(0), (inspect::WatchedItem{"Axis.Position", "m"}));
  EXPECT_EQ(mine.items.at(1).item, "Settings.Gains.kp");
  pass(100ms);
  const inspect::WatchedValues seen = here([&](View& view) { return view.watched(mine.handle); });
  EXPECT_EQ(there([&](View& view) { return view.watched(its.handle); }), seen);
  EXPECT_EQ(seen.values.size(), mine.items.size());
  EXPECT_EQ(seen.ages.at(0), 0.0);
  there([&](View& view) {
    view.end_watch(its.handle);
    return 0;
  });
  EXPECT_THAT(refusal([&](View& view) { view.watched(its.handle); }), HasSubstr("unknown watch"));
}

TEST_F(Views, HaveTheSameCycleOfAThread) {
  const auto look = [](View& view) { return view.cycle("Axis"); };
  EXPECT_EQ(here(look).number, 0u) << "nobody has asked before";
  pass(100ms);
  const inspect::Cycle cycle = here(look);
  EXPECT_GT(cycle.number, 0u);
  ASSERT_FALSE(cycle.steps.empty());
  const inspect::Cycle its = there(look);
  EXPECT_EQ(its.number, cycle.number);
  ASSERT_EQ(its.steps.size(), cycle.steps.size());
  EXPECT_EQ(its.steps.front().component, cycle.steps.front().component);
  EXPECT_NEAR(static_cast<double>((its.length - cycle.length).count()), 0.0, 2.0);
  const auto nameless = [](View& view) {
    return view.cycle("Axis", [](const std::string&) { return false; });
  };
  EXPECT_EQ(here(nameless).steps.front().component, "");
  EXPECT_EQ(there(nameless).steps.front().component, "");
  EXPECT_THAT(refusal([](View& view) { view.cycle("Axi"); }), HasSubstr("did you mean 'Axis'?"));
}

TEST_F(Views, HaveTheSameLog) {
  there([](View& view) { return view.change("Axis", inspect::LifeCycleChange::kStop); });
  exec::Application& application = robot_.application();
  for (int i = 0; i < 150; ++i) {
    auto& witness = static_cast<Witness&>(*application.find("Witness"));
    application.run_in_thread_of(witness, [&] { witness.say(i); });
    application.drain_logs();
  }
  pass(20ms);
  const inspect::LogLines all = here([](View& view) { return view.log(0); });
  ASSERT_EQ(all.lines.size(), 100u);
  EXPECT_EQ(all.left_out, 0u);
  EXPECT_EQ(there([](View& view) { return view.log(0); }), all);
  const std::uint64_t last = all.lines.back().number;
  const inspect::LogLines rest = there([&](View& view) { return view.log(last); });
  ASSERT_FALSE(rest.lines.empty());
  EXPECT_EQ(rest.lines.front().number, last + 1);
  EXPECT_EQ(rest.lines.back().text, "says 149");
  EXPECT_EQ(rest.lines.back().component, "Witness");
  EXPECT_EQ(rest.lines.back().level, rt::LogLevel::kWarning);
  const auto silent = [&](View& view) {
    return view.log(last, [](const std::string& one) { return one != "Witness"; });
  };
  EXPECT_EQ(here(silent), there(silent));
  EXPECT_EQ(here(silent).left_out, rest.lines.size());
}

TEST_F(Views, SeveralAttendOneApplicationEachWithItsOwnCommands) {
  const CommandStatus mine = here([](View& view) { return view.begin("Axis", "moveTo", {"5"}); });
  EXPECT_THAT(refusal([&](View& view) { view.cancel(mine.handle + 1); }),
              HasSubstr("unknown command handle"));
  try {
    there([&](View& view) { return view.follow(mine.handle); });
    ADD_FAILURE() << "another's command was told";
  } catch (const inspect::Refusal&) {
  }
  pass(100ms);
  EXPECT_TRUE(here_.follow(mine.handle).ended);
}

TEST_F(Views, APeerWithoutAnApplicationShowsWhatItHosts) {
  ride::Node other;
  PeerView bare(client_.connect(other.listen("tcp://127.0.0.1:0").value().text()));
  ASSERT_TRUE(bare.wait_until_connected(20s).ok());
  EXPECT_FALSE(bare.has_application());
  EXPECT_THAT(bare.component_names(), IsEmpty());
  EXPECT_THROW(bare.status(), inspect::NoAnswer);
}

/// What a peer says need not make sense.
TEST(FromTheWire, WhatMakesNoSenseIsNotTold) {
  ComponentStatus status;
  status.state = "Dancing";
  EXPECT_FALSE(internal::from_wire(status).state);
  ItemValue value = internal::from_wire(remote::ItemValue{"", "", "", "", "", true, 1e300, ""});
  EXPECT_EQ(value.age, base::Duration::zero());
  CommandStatus command = internal::from_wire(remote::CommandStatus{1, "", "lost", true, 0.0, ""});
  EXPECT_EQ(command.stage, CommandStage::kFree);
  ComponentDetails details;
  details.inputs.emplace_back().size = -7;
  details.inputs.back().max_age = std::numeric_limits<double>::quiet_NaN();
  const ComponentDescription description = internal::from_wire(details);
  EXPECT_FALSE(description.inputs.front().size);
  EXPECT_EQ(description.inputs.front().max_age, base::Duration::zero());
}

}  // namespace
}  // namespace armature::remote
