// SPDX-License-Identifier: Apache-2.0
#include "armature/deploy/builder.hpp"

#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/deploy/internal/test_models.hpp"
#include "armature/deploy/saved_properties.hpp"
#include "armature/platform/file.hpp"

namespace armature::deploy {

using namespace document;
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using namespace std::chrono_literals;
using test::deploy;
using test::entry_of;
using test::get;
namespace fs = std::filesystem;

TEST(Builder, ComponentsHaveTheirPropertiesAndActivities) {
  const Deployment deployment = deploy(R"(
application: demo
components:
  A:
    model: Source
    properties: {Rate: 180 deg, Label: left}
    activity: {periodic: 5 ms, priority: 70, cpus: [0, 1], overrun: {fault: 3}, budget: 1 ms, thread: fast}
)");
  ASSERT_TRUE(deployment.ok()) << deployment.diagnostics.to_text();
  EXPECT_EQ(deployment.blueprint.name, "demo");
  EXPECT_DOUBLE_EQ(get<test::Source>(deployment, "A").rate(), 3.141592653589793);
  EXPECT_EQ(get<test::Source>(deployment, "A").label(), "left");
  const exec::Activity& activity = entry_of(deployment, "A").activity;
  EXPECT_EQ(activity.kind, exec::Activity::Kind::kPeriodic);
  EXPECT_EQ(activity.period, 5ms);
  EXPECT_EQ(activity.priority, 70);
  EXPECT_EQ(activity.scheduler, exec::Activity::Scheduler::kRealtime);
  EXPECT_THAT(activity.cpus, ElementsAre(0, 1));
  EXPECT_EQ(activity.overrun, exec::Overrun::kFault);
  EXPECT_EQ(activity.late_cycles_to_fault, 3);
  EXPECT_EQ(activity.budget, 1ms);
  EXPECT_EQ(activity.thread, "fast");
}

/// Paper 2, section 4.1: both configure a component; only properties are in files of properties.
TEST(Builder, AttributesAreSetByTheDocumentAsPropertiesAre) {
  const Deployment deployment = deploy(R"(
components:
  A: {model: Source, properties: {Spare: 3}, activity: {periodic: 5 ms}}
)");
  ASSERT_TRUE(deployment.ok()) << deployment.diagnostics.to_text();
  EXPECT_EQ(get<test::Source>(deployment, "A").spare(), 3);
}

TEST(Builder, GrantsReachTheApplicationAndMustGrantSomething) {
  const Deployment deployment =
      deploy("components: {A: {model: Source}}\ngrants: {script: [A.arm]}\n");
  EXPECT_THAT(deployment.diagnostics.to_text(),
              HasSubstr("2:19: error: 'A' has no act of the operator 'arm' that could be granted"));
  ASSERT_EQ(deployment.options.grants.size(), 1u);
  EXPECT_EQ(deployment.options.grants[0].caller, exec::Caller::kScript);
  EXPECT_EQ(deployment.options.grants[0].component, "A");
  EXPECT_EQ(deployment.options.grants[0].operation, "arm");
}

TEST(Builder, CommandsBeforeTheStopAreCommandsWithoutArguments) {
  const Deployment deployment =
      deploy("components: {A: {model: Source}}\nbefore_stop: [A.home, B.home]\n");
  EXPECT_THAT(deployment.diagnostics.to_text(),
              AllOf(HasSubstr("2:15: error: 'A' has no command 'home' without arguments"),
                    HasSubstr("2:23: error: unknown component 'B'")));
  ASSERT_EQ(deployment.options.before_stop.size(), 2u);
  EXPECT_EQ(deployment.options.before_stop[0].component, "A");
  EXPECT_EQ(deployment.options.before_stop[0].command, "home");
}

TEST(Builder, TheBlackBoxIsAsLargeAsTheDocumentSays) {
  const exec::BlackBoxOptions box =
      deploy("black_box: {history: 5 s, memory_kB: 200}").options.black_box;
  EXPECT_EQ(box.history, 5s);
  EXPECT_EQ(box.memory, 200'000u);
  EXPECT_EQ(deploy("black_box: off").options.black_box.history, 0s);
  EXPECT_EQ(deploy("application: x").options.black_box.history, exec::BlackBoxOptions{}.history);
  EXPECT_THAT(deploy("black_box: {history: 5}").diagnostics.to_text(), HasSubstr("history"));
  EXPECT_THAT(deploy("black_box: maybe").diagnostics.to_text(),
              HasSubstr("black_box must be off or on"));
}

TEST(Builder, WhatAnActivityDoesNotSayHasTheDefaultOfTheRuntime) {
  const Deployment deployment = deploy(R"(
components:
  A: {model: Source, activity: {periodic: 5 ms}}
  B: {model: Source, activity: {triggered: true, scheduler: other}}
  C: {model: Source}
)");
  ASSERT_TRUE(deployment.ok()) << deployment.diagnostics.to_text();
  const exec::Activity plain = exec::Activity::periodic(5ms);
  const exec::Activity& periodic = entry_of(deployment, "A").activity;
  EXPECT_EQ(periodic.scheduler, plain.scheduler);
  EXPECT_EQ(periodic.overrun, plain.overrun);
  EXPECT_EQ(periodic.late_cycles_to_fault, plain.late_cycles_to_fault);
  EXPECT_EQ(entry_of(deployment, "B").activity.scheduler, exec::Activity::Scheduler::kOther);
  EXPECT_EQ(entry_of(deployment, "C").activity.kind, exec::Activity::Kind::kSequential);
}

/// The connections of two sources to a sink, with `text` as the first one's policy.
exec::ConnectionEntry connection(const std::string& text, const std::string& head = "") {
  const Deployment deployment =
      deploy(head + "\ncomponents: {A: {model: Source}, B: {model: Sink}}\nconnections:\n  - " +
             "{from: A.Out, to: B.In" + text + "}\n");
  EXPECT_TRUE(deployment.ok()) << deployment.diagnostics.to_text();
  return deployment.blueprint.connections.at(0);
}

TEST(Builder, ConnectionsCarryTheLatestValueUnlessTheyAreAFifo) {
  using Kind = component::ConnectionPolicy::Kind;
  EXPECT_EQ(connection("").policy.kind, Kind::kLatest);
  const exec::ConnectionEntry fifo = connection(", policy: {fifo: 8, overflow: drop_oldest}");
  EXPECT_EQ(fifo.policy.kind, Kind::kFifo);
  EXPECT_EQ(fifo.policy.capacity, 8u);
  EXPECT_EQ(fifo.policy.when_full, rt::WhenFull::kDropOldest);
  EXPECT_EQ(connection(", policy: {fifo: 8}").policy.when_full, rt::WhenFull::kDropNewest);
  EXPECT_TRUE(connection(", delay: one_cycle").policy.one_cycle_delay);
}

TEST(Builder, AnAgeWithoutAReactionHasThePortsOwn) {
  EXPECT_FALSE(connection("").max_age.has_value());
  const exec::ConnectionEntry own = connection(", max_age: 20 ms");
  ASSERT_TRUE(own.max_age.has_value());
  EXPECT_EQ(own.max_age->age, 20ms);
  EXPECT_EQ(own.max_age->reaction, component::Reaction::kZero);
  EXPECT_EQ(connection(", max_age: 20 ms, on_old: fault").max_age->reaction,
            component::Reaction::kFault);
}

TEST(Builder, ReadersOutliveTheirWritersOnlyIfTheDocumentSaysSo) {
  EXPECT_FALSE(connection("").on_lost.has_value());
  EXPECT_EQ(connection(", on_lost: zero").on_lost->reaction, component::Reaction::kZero);
  EXPECT_EQ(connection("", "on_fault: keep_running").on_lost->reaction, component::Reaction::kHold);
  EXPECT_EQ(connection(", on_lost: stop", "on_fault: keep_running").on_lost->reaction,
            component::Reaction::kStop);
}

TEST(Builder, AFaultStopsAllIfTheDocumentSaysSo) {
  EXPECT_EQ(deploy("on_fault: stop_all").options.on_fault, exec::OnFault::kStopAll);
  EXPECT_EQ(deploy("on_fault: stop_dependents").options.on_fault, exec::OnFault::kStopDependents);
  EXPECT_EQ(deploy("application: x").options.on_fault, exec::OnFault::kStopDependents);
}

TEST(Builder, ADelayHoldsForAllConnectionsBetweenTwoComponents) {
  const Deployment deployment = deploy(R"(
components:
  A: {model: Source}
  B: {model: Sink, delays: [A]}
  C: {model: Sink}
connections:
  - A.Out -> B.In
  - A.Out -> C.In
)");
  ASSERT_TRUE(deployment.ok()) << deployment.diagnostics.to_text();
  EXPECT_TRUE(deployment.blueprint.connections[0].policy.one_cycle_delay);
  EXPECT_FALSE(deployment.blueprint.connections[1].policy.one_cycle_delay);
}

TEST(Builder, PortsOfANamedConnectionAreJoinedByTheirDirection) {
  const Deployment deployment = deploy(R"(
components:
  A{1..2}: {model: Source}
  B{1..2}: {model: Sink}
connections:
  - {name: angle, ports: [B1.All, A1.Out, B2.All, A2.Out], policy: {fifo: 4}}
)");
  ASSERT_TRUE(deployment.ok()) << deployment.diagnostics.to_text();
  std::vector<std::string> ways;
  for (const exec::ConnectionEntry& entry : deployment.blueprint.connections) {
    ways.push_back(entry.from_component + " " + entry.to_component);
    EXPECT_EQ(entry.policy.capacity, 4u);
  }
  EXPECT_THAT(ways, ElementsAre("A1 B1", "A1 B2", "A2 B1", "A2 B2"));
}

TEST(Builder, ANamedConnectionWithoutAWriterIsAnError) {
  const Deployment deployment =
      deploy("components: {B: {model: Sink}}\nconnections: [{name: x, ports: [B.In, B.All]}]\n");
  EXPECT_THAT(deployment.diagnostics.to_text(),
              HasSubstr("app.yaml:2:15: error: connection 'x' has no output port"));
}

TEST(Builder, APartOfACompositeKnowsItsPeerByItsOwnName) {
  Deployment deployment = deploy(R"(
composites:
  Axis:
    components:
      card: {model: Card}
      joint: {model: Joint, activity: {periodic: 10 ms}, peers: [card], properties: {PeerName: card}}
    exports: {ports: {Position: joint.Out}}
components:
  Left: {model: Axis}
  Right: {model: Axis}
  Sink: {model: Sink, activity: {periodic: 10 ms}}
connections:
  - Left.Position -> Sink.In
)");
  ASSERT_TRUE(deployment.ok()) << deployment.diagnostics.to_text();
  ASSERT_EQ(deployment.plan.calls.size(), 2u);
  for (const exec::CallPlan& call : deployment.plan.calls) {
    const std::string user = deployment.blueprint.components[call.caller].component->name();
    const std::string used = deployment.blueprint.components[call.callee].component->name();
    EXPECT_EQ(user.substr(0, user.find('.')), used.substr(0, used.find('.')));
  }
  deployment.options.simulated = true;
  exec::Application application(std::move(deployment.blueprint), deployment.options);
  ASSERT_TRUE(application.start().ok());
  application.run_for(100ms);
  EXPECT_EQ(application.value_of("Sink", "In").value().text(), "7");
}

TEST(Builder, WhatIsNotToStartByItselfWaitsUntilItIsTold) {
  Deployment deployment = deploy(R"(
components:
  A: {model: Source, activity: {periodic: 10 ms}, autostart: false}
  B: {model: Source, activity: {periodic: 10 ms}, autoconf: false, autostart: false}
  C: {model: Source, activity: {periodic: 10 ms}}
)");
  ASSERT_TRUE(deployment.ok()) << deployment.diagnostics.to_text();
  deployment.options.simulated = true;
  exec::Application application(std::move(deployment.blueprint), deployment.options);
  ASSERT_TRUE(application.start().ok());
  EXPECT_EQ(application.find("A")->state(), component::State::kStopped);
  EXPECT_EQ(application.find("B")->state(), component::State::kPreOperational);
  EXPECT_EQ(application.find("C")->state(), component::State::kRunning);
  EXPECT_TRUE(application.start_component("A"));
  EXPECT_TRUE(application.start_component("B"));
  EXPECT_EQ(application.find("B")->state(), component::State::kRunning);
  application.stop();
  EXPECT_EQ(application.find("A")->state(), component::State::kPreOperational);
}

TEST(Builder, OneMistakeHasOneMessage) {
  const auto errors = [](std::string_view yaml) { return deploy(yaml).diagnostics.error_count(); };
  // An unknown model leaves a component out, on which others depend in every way.
  EXPECT_EQ(errors(R"(
components:
  Crad: {model: Crad}
  Joint: {model: Joint, peers: [Crad], bind: {read: Crad.read}, properties: {PeerName: Crad}}
  Echo: {model: Echo, delays: [Crad]}
connections:
  - Crad.Out -> Echo.In
  - {name: x, ports: [Crad.Out, Echo.In]}
)"),
            1u);
  // A number of ports that is unknown says nothing about the ports.
  EXPECT_EQ(errors(R"(
components:
  A{1..2}: {model: Source}
  Mux: {model: Mux, properties: {joints: two}}
connections:
  - A{i}.Out -> Mux.Position{i}
)"),
            1u);
  // What a composite does not export is said once.
  EXPECT_EQ(errors(R"(
composites:
  Box:
    components: {a: {model: Source}}
    exports: {ports: {Out: a.Out}}
components: {B: {model: Box}, S: {model: Sink}}
connections: [B.Otu -> S.In]
)"),
            1u);
}

TEST(Builder, ModelsOfAMissingLibraryAreNotReportedOneByOne) {
  const Deployment deployment =
      deploy("libraries: [nowhere]\ncomponents:\n  A: {model: Gripper}\n  B: {model: Sorce}\n");
  EXPECT_EQ(deployment.diagnostics.error_count(), 2u) << deployment.diagnostics.to_text();
  EXPECT_THAT(deployment.diagnostics.to_text(), HasSubstr("'nowhere'"));
  EXPECT_THAT(deployment.diagnostics.to_text(), HasSubstr("did you mean 'Source'?"));
}

/// A folder with files, which goes with the test.
class PropertyFiles : public ::testing::Test {
 protected:
  PropertyFiles() : folder_(fs::path(::testing::TempDir()) / "armature_builder_test") {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~PropertyFiles() override { fs::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& content) {
    const std::string path = (folder_ / name).string();
    EXPECT_TRUE(platform::write_file(path, content).ok());
    return path;
  }
  Deployment load(const std::string& yaml) {
    DeploymentOptions options;
    options.models = &test::add_models;
    return load_deployment(write("app.yaml", yaml), options);
  }
  std::string read(const std::string& name) {
    return platform::read_file((folder_ / name).string()).value();
  }

  fs::path folder_;
};

TEST_F(PropertyFiles, ComeFirstAndTheDocumentsOwnPropertiesWin) {
  write("a.cpf",
        "<properties><simple name='Rate' type='double'><value>2</value></simple>"
        "<simple name='Label' type='string'><value>from file</value></simple></properties>");
  const Deployment deployment =
      load("components: {A: {model: Source, property_file: a.cpf, properties: {Label: own}}}\n");
  ASSERT_TRUE(deployment.ok()) << deployment.diagnostics.to_text();
  EXPECT_EQ(get<test::Source>(deployment, "A").rate(), 2.0);
  EXPECT_EQ(get<test::Source>(deployment, "A").label(), "own");
}

TEST_F(PropertyFiles, AnAttributeInAFileIsRefused) {
  write("a.cpf",
        "<properties><simple name='Spare' type='long'><value>3</value></simple></properties>");
  const Deployment deployment =
      load("components: {A: {model: Source, property_file: a.cpf, properties: {Rate: 1}}}\n");
  EXPECT_FALSE(deployment.ok());
  EXPECT_THAT(deployment.diagnostics.to_text(),
              AllOf(HasSubstr("a.cpf:1:"),
                    HasSubstr("error: 'Spare' of 'A' (Source) is an attribute, which a property "
                              "file cannot give (remove it from the file)")));
}

TEST_F(PropertyFiles, MistakesInAFileThatManyShareAreReportedForEachButReadOnce) {
  write("a.cpf", "<properties><simple name='Rate' type='double'><value>x</value></simple>");
  const Deployment deployment =
      load("components:\n  A{1..3}: {model: Source, property_file: a.cpf}\n");
  EXPECT_EQ(deployment.diagnostics.error_count(), 1u) << deployment.diagnostics.to_text();
  EXPECT_THAT(deployment.diagnostics.to_text(), HasSubstr("a.cpf:1:"));
}

TEST_F(PropertyFiles, AutosaveKeepsPersistentPropertiesForTheNextRun) {
  const std::string yaml =
      "components:\n"
      "  A: {model: Source, property_file: a.cpf, autosave: true, activity: {periodic: 1 s}}\n";
  const Deployment first = load(yaml);
  ASSERT_TRUE(first.ok()) << first.diagnostics.to_text();
  EXPECT_THAT(first.diagnostics.to_text(),
              HasSubstr("a.cpf' does not exist yet; it is written at stop"));
  get<test::Source>(first, "A").rate.assign(0.1);
  get<test::Source>(first, "A").label.assign("<&>");
  base::Diagnostics diagnostics;
  save_properties(first.document, first.blueprint, diagnostics);
  EXPECT_TRUE(diagnostics.empty()) << diagnostics.to_text();
  EXPECT_THAT(read("a.cpf"), HasSubstr("step of each update"));
  EXPECT_THAT(read("a.cpf"), ::testing::Not(HasSubstr("Spare")));
  const Deployment second = load(yaml);
  ASSERT_TRUE(second.diagnostics.empty()) << second.diagnostics.to_text();
  EXPECT_EQ(get<test::Source>(second, "A").rate(), 0.1);
  EXPECT_EQ(get<test::Source>(second, "A").label(), "<&>");
}

TEST_F(PropertyFiles, WhatCannotBeSavedIsSaid) {
  const Deployment deployment =
      load("components: {A: {model: Source, property_file: no/such/a.cpf, autosave: true}}\n");
  ASSERT_TRUE(deployment.ok()) << deployment.diagnostics.to_text();
  base::Diagnostics diagnostics;
  save_properties(deployment.document, deployment.blueprint, diagnostics);
  EXPECT_THAT(diagnostics.to_text(),
              HasSubstr("error: the properties of 'A' were not saved: cannot write"));
}

}  // namespace
}  // namespace armature::deploy
