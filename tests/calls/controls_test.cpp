// SPDX-License-Identifier: Apache-2.0
// Sequence and Request: what they call, what becomes of it, and mistakes of deployments.
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/author.hpp"
#include "armature/deploy/deployment.hpp"
#include "armature/exec/application.hpp"
#include "armature/general/controls/displays.hpp"
#include "armature/general/controls/latch.hpp"
#include "armature/general/controls/request.hpp"
#include "armature/general/controls/sequence.hpp"
#include "armature/general/controls/timer.hpp"

namespace armature {
namespace {

using namespace std::chrono_literals;
using component::Outcome;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// The visual component of paper 4, table 4: it is initialized, told its threshold, and started.
class Vision final : public component::Component {
 public:
  using Component::Component;
  std::vector<std::string> told;
  bool ready = true;
  int cancelled = 0;

 private:
  bool initialize() {
    told.push_back("initialize");
    return ready;
  }
  std::int32_t set_threshold(double low, double high) {
    told.push_back("setThreshold " + std::to_string(std::lround(low)) + " " +
                   std::to_string(std::lround(high)));
    return 0;
  }
  Outcome start_it() {
    told.push_back("start");
    left_ = 3;
    return component::accepted();
  }
  Outcome jam() { return component::refused("the lens is dirty"); }
  Outcome turn_on_light() { return component::accepted(); }
  double distance() { return 1.5 + 0.5 * asked_++; }
  std::string label() { return "ball"; }
  bool has_started() { return left_ > 0 && --left_ == 0; }
  void cancel() { ++cancelled; }
  void on_update() override { seen_.write(7.0); }

  component::Operation<bool()> initialize_{
      this, "initialize", component::serve<&Vision::initialize>, "", component::in_own_thread};
  component::Operation<std::int32_t(double, double)> threshold_{
      this, "setThreshold", component::serve<&Vision::set_threshold>, "",
      component::args("low [m]", "high [m]")};
  component::Command<> start_{this,
                              "start",
                              component::serve<&Vision::start_it>,
                              "",
                              component::done_when<&Vision::has_started>,
                              component::cancelled_by<&Vision::cancel>};
  component::Command<> jam_{this, "jam", component::serve<&Vision::jam>, ""};
  component::Command<> light_{this, "light", component::serve<&Vision::turn_on_light>, "",
                              component::by_operator};
  component::Operation<double()> distance_{this, "distance", component::serve<&Vision::distance>,
                                           ""};
  component::Operation<std::string()> label_{this, "label", component::serve<&Vision::label>, ""};
  component::OutputPort<double> seen_{this, "Seen", "", "m"};
  component::OutputPort<double> never_{this, "Never", "", "m"};
  component::OutputPort<double> angle_{this, "Angle", "", "rad"};
  int left_ = 0;
  int asked_ = 0;
};

/// Counts what it is told.
class Log final : public component::Component {
 public:
  using Component::Component;
  int notes = 0;
  std::vector<double> numbers;

 private:
  Outcome note() {
    ++notes;
    note_.complete();
    return component::accepted();
  }
  Outcome take(double number) {
    numbers.push_back(number);
    take_.complete();
    return component::accepted();
  }
  component::Command<> note_{this, "note", component::serve<&Log::note>, ""};
  component::Command<double> take_{this, "take", component::serve<&Log::take>, "",
                                   component::args("number")};
};

constexpr const char* kParts = R"(
components:
  Vision: {model: Vision, activity: {periodic: 10 ms}}
  Log: {model: Log, activity: {periodic: 10 ms}}
  Tick: {model: Timer, activity: {periodic: 10 ms}, properties: {Period: 0.1, Repeat: false}}
)";

deploy::Deployment deployment(const std::string& more) {
  deploy::DeploymentOptions options;
  options.cpus = 2;
  options.models = [](component::Registry& models) {
    models.add<Vision>("Vision", "sees", {});
    models.add<Log>("Log", "counts", {});
    models.add<general::Timer>("Timer", "", {});
    models.add<general::Latch>("Latch", "", {});
    models.add<general::Number>("Number", "", {});
    models.add<general::Sequence>("Sequence", "", {});
    models.add<general::Request>("Request", "", {});
  };
  return deploy::parse_deployment(kParts + more, "robot.yaml", options);
}

std::string mistakes(const std::string& more) { return deployment(more).diagnostics.to_text(); }

/// Runs in simulated time.
class Running {
 public:
  explicit Running(const std::string& more) {
    deploy::Deployment made = deployment(more);
    EXPECT_TRUE(made.ok()) << made.diagnostics.to_text();
    made.options.simulated = true;
    application_ = std::make_unique<exec::Application>(std::move(made.blueprint), made.options);
    EXPECT_EQ(application_->start().to_text(), "");
  }
  void run_for(base::Duration time) { application_->run_for(time); }
  Vision& vision() { return dynamic_cast<Vision&>(*application_->find("Vision")); }
  Log& log() { return dynamic_cast<Log&>(*application_->find("Log")); }
  exec::Application& application() { return *application_; }
  std::string text_of(const char* component, const char* item) {
    return application_->value_of(component, item).value().text();
  }

 private:
  std::unique_ptr<exec::Application> application_;
};

constexpr const char* kPrepare = R"(
  Prepare:
    model: Sequence
    activity: {periodic: 10 ms}
    calls:
      - Vision.initialize
      - {call: Vision.setThreshold, with: {low: 200 cm, high: Vision.Seen}}
      - Vision.start
connections:
  - {on: Tick.Tick, do: Prepare.run, name: Begin}
  - Prepare.Done -> Log.note
)";

TEST(Sequence, DoesItsCallsOneAfterTheOther) {
  Running robot(kPrepare);
  robot.run_for(110ms);
  EXPECT_THAT(robot.vision().told, ElementsAre("initialize", "setThreshold 2 7", "start"));
  EXPECT_EQ(robot.log().notes, 0) << "the start takes three updates";
  robot.run_for(100ms);
  EXPECT_EQ(robot.log().notes, 1);
  EXPECT_EQ(robot.text_of("Begin", "Given"), "1");
  EXPECT_EQ(robot.text_of("Begin", "Failures"), "0");
}

TEST(Sequence, RunsInTheThreadOfWhomItCalls) {
  std::string here(kPrepare);
  here.replace(here.find("activity: {periodic: 10 ms}"), 27, "activity: sequential");
  Running robot(here);
  robot.run_for(300ms);
  EXPECT_EQ(robot.vision().told.size(), 3u);
  EXPECT_EQ(robot.log().notes, 1);
}

TEST(Sequence, FailsWithTheCallThatFailsAndSaysWhy) {
  Running robot(R"(
  Prepare:
    model: Sequence
    activity: {periodic: 10 ms}
    calls: [Vision.initialize, Vision.jam, Vision.start]
connections:
  - {on: Tick.Tick, do: Prepare.run, name: Begin}
  - Prepare.Failed -> Log.note
)");
  robot.run_for(300ms);
  EXPECT_THAT(robot.vision().told, ElementsAre("initialize"));
  EXPECT_EQ(robot.log().notes, 1);
  EXPECT_EQ(robot.text_of("Prepare", "Call"), "2");
  EXPECT_EQ(robot.text_of("Prepare", "Why"), "Vision.jam: the lens is dirty");
  EXPECT_EQ(robot.text_of("Begin", "Failures"), "1");
}

TEST(Sequence, FailsWhereAnOperationReturnsFalse) {
  Running robot(kPrepare);
  robot.vision().ready = false;
  robot.run_for(300ms);
  EXPECT_THAT(robot.vision().told, ElementsAre("initialize"));
  EXPECT_EQ(robot.text_of("Prepare", "Why"), "Vision.initialize: it returned false");
}

TEST(Sequence, FailsForWantOfAValueOfAPort) {
  std::string never(kPrepare);
  never.replace(never.find("Vision.Seen"), 11, "Vision.Never");
  Running robot(never);
  robot.run_for(300ms);
  EXPECT_THAT(robot.vision().told, ElementsAre("initialize"));
  EXPECT_THAT(robot.text_of("Prepare", "Why"), HasSubstr("was never written"));
}

TEST(Sequence, ThatIsCancelledCancelsTheCallThatIsUnderWay) {
  Running robot(R"(
  Prepare: {model: Sequence, activity: {periodic: 10 ms}, calls: [Vision.start, Vision.initialize]}
)");
  robot.run_for(50ms);
  auto begun = robot.application().begin("Prepare", "run", {});
  ASSERT_TRUE(begun);
  robot.run_for(10ms);
  EXPECT_THAT(robot.vision().told, ElementsAre("start"));
  begun.value().cancel();
  robot.run_for(100ms);
  EXPECT_EQ(begun.value().stage(), component::CommandStage::kCancelled);
  EXPECT_EQ(robot.vision().cancelled, 1);
  EXPECT_THAT(robot.vision().told, ElementsAre("start")) << "nothing else begins";
  auto again = robot.application().begin("Prepare", "run", {});
  ASSERT_TRUE(again);
  robot.run_for(200ms);
  EXPECT_EQ(again.value().stage(), component::CommandStage::kDone);
  EXPECT_THAT(robot.vision().told, ElementsAre("start", "start", "initialize"));
}

TEST(Sequence, ThatIsStoppedBeginsNothingMore) {
  Running robot(kPrepare);
  robot.run_for(115ms);
  ASSERT_TRUE(robot.application().stop_component("Prepare"));
  robot.run_for(300ms);
  EXPECT_EQ(robot.vision().cancelled, 1) << "the start was under way";
  EXPECT_EQ(robot.log().notes, 0);
}

TEST(Sequence, IsTheSameInEveryRun) {
  Running first(kPrepare);
  Running second(kPrepare);
  first.run_for(300ms);
  for (int i = 0; i < 30; ++i) second.run_for(10ms);
  EXPECT_EQ(first.vision().told, second.vision().told);
  EXPECT_EQ(first.log().notes, second.log().notes);
}

constexpr const char* kAsk = R"(
  Ask: {model: Request, activity: {periodic: 10 ms}, calls: Vision.distance, properties: {Unit: m}}
  Again: {model: Timer, activity: {periodic: 10 ms}, properties: {Period: 0.1}}
  Show: {model: Number, properties: {Unit: m}}
connections:
  - {on: Again.Tick, do: Ask.ask, name: Asked}
  - Ask.Answered -> Log.take
  - Ask.Failed -> Log.note
  - Ask.Result -> Show.Value
)";

constexpr const char* kLatched = R"(
  Ask: {model: Request, activity: {periodic: 10 ms}, calls: Vision.distance, properties: {Unit: m}}
  Again: {model: Timer, activity: {periodic: 10 ms}, properties: {Period: 0.1}}
  Last: {model: Latch, activity: {periodic: 10 ms}, properties: {Unit: ""}}
  Show: {model: Number}
connections:
  - {on: Again.Tick, do: Ask.ask, name: Asked}
  - {on: Ask.Answered, do: Last.set}
  - Last.Out -> Show.Value
)";

TEST(Latch, MakesAValueOfAMemberOfAnEvent) {
  Running robot(kLatched);
  robot.run_for(350ms);
  EXPECT_EQ(robot.text_of("Show", "Value"), "2.5");
}

TEST(Latch, TakesMembersOfItsUnitOnly) {
  std::string other(kLatched);
  other.replace(other.find("Unit: \"\""), 8, "Unit: rad");
  EXPECT_THAT(mistakes(other), HasSubstr("'value' of 'Last.set' is double in 'rad'"));
}

TEST(Request, WritesWhatIsAnsweredEachTimeThatItAsks) {
  Running robot(kAsk);
  robot.run_for(350ms);
  EXPECT_THAT(robot.log().numbers, ElementsAre(1.5, 2.0, 2.5));
  EXPECT_EQ(robot.text_of("Show", "Value"), "2.5");
  EXPECT_EQ(robot.log().notes, 0);
}

TEST(Request, TellsThatThereIsNoAnswer) {
  std::string late(kAsk);
  late.replace(late.find("Vision.distance"), 15, "Late.distance");
  Running robot("  Late: {model: Vision, autoconf: false, autostart: false}\n" + late.substr(1));
  robot.run_for(250ms);
  EXPECT_THAT(robot.log().numbers, ElementsAre());
  EXPECT_EQ(robot.log().notes, 2);
  EXPECT_EQ(robot.text_of("Asked", "Failures"), "2");
}

TEST(Calls, OfACompositeAreMadeByItsParts) {
  Running robot(R"(
  Eye: {model: Camera}
composites:
  Camera:
    components:
      Vision: {model: Vision, activity: {periodic: 10 ms}}
      Prepare: {model: Sequence, activity: {periodic: 10 ms}, calls: [Vision.initialize, Vision.start]}
    exports:
      operations: {prepare: Prepare.run}
connections:
  - Tick.Tick -> Eye.prepare
)");
  robot.run_for(300ms);
  const auto& eye = dynamic_cast<const Vision&>(*robot.application().find("Eye.Vision"));
  EXPECT_THAT(eye.told, ElementsAre("initialize", "start"));
  EXPECT_THAT(robot.vision().told, ElementsAre());
}

std::string of_sequence(const std::string& calls) {
  return mistakes("  Prepare: {model: Sequence, activity: {periodic: 10 ms}, calls: " + calls +
                  "}\n");
}

TEST(Calls, AreCheckedForNamesTypesAndUnits) {
  EXPECT_THAT(of_sequence("[Visoin.start]"), HasSubstr("unknown component 'Visoin'"));
  EXPECT_THAT(of_sequence("[Vision.strat]"),
              HasSubstr("'Vision' has no operation or command 'strat'"));
  EXPECT_THAT(of_sequence("[Vision.setThreshold]"),
              HasSubstr("nothing gives the parameter 'low' of 'Vision.setThreshold'"));
  EXPECT_THAT(of_sequence("[{call: Vision.setThreshold, with: {low: 1 m, hihg: 2 m, high: 2 m}}]"),
              HasSubstr("'Vision.setThreshold' has no parameter 'hihg'"));
  EXPECT_THAT(of_sequence("[{call: Vision.setThreshold, with: {low: 1 s, high: 2 m}}]"),
              HasSubstr("parameter 'low' of 'Vision.setThreshold'"));
  EXPECT_THAT(of_sequence("[{call: Vision.setThreshold, with: {low: 1 m, high: Vision.Angle}}]"),
              HasSubstr("'Vision.Angle' is double in 'rad', but 'high' of 'Vision.setThreshold' is "
                        "double in 'm'"));
}

TEST(Calls, DoNoActOfTheOperator) {
  EXPECT_THAT(of_sequence("[Vision.light]"),
              HasSubstr("'Vision.light' is an act of the operator: no other component does it"));
}

TEST(Calls, BelongToThoseThatMakeThem) {
  EXPECT_THAT(mistakes("  Other: {model: Log, calls: [Vision.start]}\n"),
              HasSubstr("'Other' (Log) does not take calls from a deployment"));
  EXPECT_THAT(mistakes("  Prepare: {model: Sequence}\n"),
              HasSubstr("'Prepare' (Sequence) has no calls"));
  EXPECT_THAT(of_sequence("[Prepare.run]"), HasSubstr("'Prepare' calls itself"));
  EXPECT_THAT(of_sequence("[{with: {low: 1}}]"), HasSubstr("an entry of calls has no 'call'"));
}

TEST(Request, TakesOneOperationWhoseResultHasAFixedSize) {
  const std::string ask = "  Ask: {model: Request, activity: {periodic: 10 ms}, calls: ";
  EXPECT_THAT(mistakes(ask + "[Vision.distance, Vision.label]}\n"),
              HasSubstr("'Ask' (Request) makes 1 call, found 2"));
  EXPECT_THAT(mistakes(ask + "Vision.start}\n"), HasSubstr("is a command, which answers nothing"));
  EXPECT_THAT(mistakes(ask + "Vision.label}\n"), HasSubstr("no port takes here"));
}

TEST(Request, HasTheUnitThatItsDeploymentGivesIt) {
  std::string wrong(kAsk);
  wrong.replace(wrong.find("{Unit: m}"), 9, "{Unit: s}");
  EXPECT_THAT(mistakes(wrong), HasSubstr("'Ask.Result'"));
}

}  // namespace
}  // namespace armature
