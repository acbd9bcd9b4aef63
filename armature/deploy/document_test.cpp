// SPDX-License-Identifier: Apache-2.0
#include "armature/document/document.hpp"

#include <gtest/gtest.h>

#include "armature/deploy/internal/document_in_memory.hpp"

namespace armature::deploy {

using namespace document;
namespace {

using internal::load_yaml;
using internal::Loaded;
using std::chrono::microseconds;
using std::chrono::milliseconds;

Component component(const std::string& body) {
  const Loaded loaded = load_yaml("components:\n  A: " + body + "\n");
  EXPECT_EQ(loaded.messages(), "");
  return loaded.document.components.at(0);
}

Connection connection(const std::string& text) {
  const Loaded loaded = load_yaml("connections:\n  - " + text + "\n");
  EXPECT_EQ(loaded.messages(), "");
  return loaded.document.connections.at(0);
}

TEST(Document, EmptyTextIsAnEmptyDocument) {
  const Loaded loaded = load_yaml("");
  EXPECT_EQ(loaded.messages(), "");
  EXPECT_TRUE(loaded.document.components.empty());
}

TEST(Document, SectionsThatAreCommentedOutAreEmpty) {
  const Loaded loaded = load_yaml("components:\n  # none yet\nconnections:\n");
  EXPECT_EQ(loaded.messages(), "");
}

TEST(Document, HasNameLibrariesAndFaultPolicy) {
  const Loaded loaded =
      load_yaml("application: janus-head\non_fault: stop_all\nlibraries: [robot, motion]\n");
  EXPECT_EQ(loaded.messages(), "");
  EXPECT_EQ(loaded.document.application, "janus-head");
  EXPECT_EQ(loaded.document.on_fault, OnFault::kStopAll);
  ASSERT_EQ(loaded.document.libraries.size(), 2u);
  EXPECT_EQ(loaded.document.libraries[1].name, "motion");
  EXPECT_EQ(loaded.document.libraries[1].where, (base::Location{"robot.yaml", 3, 20}));
}

TEST(Document, OneLibraryNeedsNoList) {
  EXPECT_EQ(load_yaml("libraries: robot\n").document.libraries.at(0).name, "robot");
}

TEST(Document, ComponentsKeepTheirOrderAndPlace) {
  const Loaded loaded = load_yaml("components:\n  B: {model: M}\n  A:\n    model: N\n");
  ASSERT_EQ(loaded.document.components.size(), 2u);
  EXPECT_EQ(loaded.document.components[0].name, "B");
  EXPECT_EQ(loaded.document.components[1].model, "N");
  EXPECT_EQ(loaded.document.components[1].where, (base::Location{"robot.yaml", 3, 3}));
  EXPECT_EQ(loaded.document.components[1].model_where, (base::Location{"robot.yaml", 4, 12}));
}

TEST(Document, ComponentIsSequentialConfiguredAndStartedUnlessSaid) {
  const Component plain = component("{model: M}");
  EXPECT_EQ(plain.activity.kind, Activity::Kind::kSequential);
  EXPECT_TRUE(plain.autoconf);
  EXPECT_TRUE(plain.autostart);
  EXPECT_FALSE(plain.autosave);
}

TEST(Document, PeriodicActivityHasAllItsSettings) {
  const Activity activity =
      component(
          "{model: M, activity: {periodic: 10 ms, priority: 80, scheduler: realtime, "
          "cpus: [3, 1, 3], overrun: {fault: 4}, thread: fast, budget: 200 us}}")
          .activity;
  EXPECT_EQ(activity.kind, Activity::Kind::kPeriodic);
  EXPECT_EQ(activity.period, milliseconds(10));
  EXPECT_EQ(activity.priority, 80);
  EXPECT_EQ(activity.scheduler, Activity::Scheduler::kRealtime);
  EXPECT_EQ(activity.cpus, (std::vector<int>{1, 3}));
  EXPECT_EQ(activity.overrun, Overrun::kFault);
  EXPECT_EQ(activity.late_cycles_to_fault, 4);
  EXPECT_EQ(activity.thread, "fast");
  EXPECT_EQ(activity.budget, microseconds(200));
  EXPECT_EQ(activity.where, (base::Location{"robot.yaml", 2, 27}));
}

TEST(Document, ActivityKeepsOpenWhatIsNotSaid) {
  const Activity activity = component("{model: M, activity: {triggered: true}}").activity;
  EXPECT_EQ(activity.kind, Activity::Kind::kTriggered);
  EXPECT_EQ(activity.priority, 0);
  EXPECT_FALSE(activity.scheduler_given);
  EXPECT_EQ(activity.overrun, Overrun::kSkip);
  EXPECT_EQ(activity.budget, base::Duration::zero());
}

TEST(Document, ActivityHasAShortForm) {
  EXPECT_EQ(component("{model: M, activity: triggered}").activity.kind, Activity::Kind::kTriggered);
  EXPECT_EQ(component("{model: M, activity: sequential}").activity.kind,
            Activity::Kind::kSequential);
}

TEST(Document, OverrunHasAShortForm) {
  const auto overrun = [](const std::string& text) {
    return component("{model: M, activity: {periodic: 1 ms, overrun: " + text + "}}")
        .activity.overrun;
  };
  EXPECT_EQ(overrun("skip"), Overrun::kSkip);
  EXPECT_EQ(overrun("catch_up"), Overrun::kCatchUp);
  EXPECT_EQ(overrun("fault"), Overrun::kFault);
}

TEST(Document, DurationsMayHaveAnyUnitOfTime) {
  const auto period = [](const std::string& text) {
    return component("{model: M, activity: {periodic: " + text + "}}").activity.period;
  };
  EXPECT_EQ(period("0.5 s"), milliseconds(500));
  EXPECT_EQ(period("250us"), microseconds(250));
  EXPECT_EQ(period("10500 ns"), base::Duration(10'500));
  EXPECT_EQ(period("0.1 ms"), microseconds(100));
}

TEST(Document, PropertiesAreTreesWithTheirPlaces) {
  const Component it = component("{model: M, properties: {x: 0.5, v: [1, 2], s: {a: \"t u\"}}}");
  ASSERT_EQ(it.properties.size(), 3u);
  EXPECT_EQ(it.properties[0].name, "x");
  EXPECT_EQ(it.properties[0].value.kind, Value::Kind::kText);
  EXPECT_EQ(it.properties[0].value.text, "0.5");
  EXPECT_EQ(it.properties[0].where, (base::Location{"robot.yaml", 2, 30}));
  EXPECT_EQ(it.properties[0].value.where, (base::Location{"robot.yaml", 2, 33}));
  EXPECT_EQ(it.properties[1].value.kind, Value::Kind::kList);
  EXPECT_EQ(it.properties[1].value.items.at(1).text, "2");
  EXPECT_EQ(it.properties[2].value.kind, Value::Kind::kMap);
  EXPECT_EQ(find(it.properties[2].value.entries, "a")->value.text, "t u");
}

TEST(Document, PeersMayBeOneAListOrNamed) {
  const auto peers = [](const std::string& text) {
    std::string found;
    for (const Peer& peer : component("{model: M, peers: " + text + "}").peers) {
      found += peer.name + "=" + peer.component + " ";
    }
    return found;
  };
  EXPECT_EQ(peers("B"), "B=B ");
  EXPECT_EQ(peers("[B, C]"), "B=B C=C ");
  EXPECT_EQ(peers("[B, {card: C}]"), "B=B card=C ");
  EXPECT_EQ(peers("{card: C, axis: D}"), "card=C axis=D ");
}

TEST(Document, BindingsNameAPeerAndWhatItOffers) {
  const Component it = component("{model: M, bind: {read: card.sensorRead, write: card}}");
  ASSERT_EQ(it.bindings.size(), 2u);
  EXPECT_EQ(it.bindings[0].name, "read");
  EXPECT_EQ(it.bindings[0].component, "card");
  EXPECT_EQ(it.bindings[0].member, "sensorRead");
  EXPECT_EQ(it.bindings[1].component, "card");
  EXPECT_EQ(it.bindings[1].member, "write");
}

TEST(Document, ComponentHasPropertyFilesDelaysAndFlags) {
  const Component it = component(
      "{model: M, property_file: [a.cpf, {file: b.cpf, complete: true}], delays: [B], "
      "autoconf: true, autostart: false, autosave: true}");
  ASSERT_EQ(it.property_files.size(), 2u);
  EXPECT_EQ(it.property_files[0].path, "a.cpf");
  EXPECT_FALSE(it.property_files[0].complete);
  EXPECT_EQ(it.property_files[1].path, "b.cpf");
  EXPECT_TRUE(it.property_files[1].complete);
  EXPECT_EQ(it.delays.at(0).name, "B");
  EXPECT_FALSE(it.autostart);
  EXPECT_TRUE(it.autosave);
}

TEST(Document, ArrowConnectsTwoPortsWithTheLatestValue) {
  const Connection it = connection("A.Out -> B.In");
  EXPECT_EQ(it.from.component, "A");
  EXPECT_EQ(it.from.port, "Out");
  EXPECT_EQ(it.to.component, "B");
  EXPECT_EQ(it.to.port, "In");
  EXPECT_EQ(it.policy.kind, ConnectionPolicy::Kind::kLatest);
  EXPECT_FALSE(it.policy.max_age);
  EXPECT_EQ(it.policy.on_old, std::nullopt);
}

TEST(Document, EndsOfAnArrowHaveTheirOwnPlaces) {
  const Connection it = connection("A.Out ->  B.In");
  EXPECT_EQ(it.from.where, (base::Location{"robot.yaml", 2, 5}));
  EXPECT_EQ(it.to.where, (base::Location{"robot.yaml", 2, 15}));
}

TEST(Document, ConnectionHasAllItsSettings) {
  const Connection it = connection(
      "{from: A.Out, to: B.In, policy: {fifo: 8, overflow: drop_oldest}, max_age: 30 ms, "
      "on_old: stop, on_lost: zero, delay: one_cycle, fan_in: true}");
  EXPECT_EQ(it.policy.capacity, 8u);
  EXPECT_EQ(it.policy.when_full, rt::WhenFull::kDropOldest);
  EXPECT_EQ(it.policy.max_age, milliseconds(30));
  EXPECT_EQ(it.policy.on_old, Reaction::kStop);
  EXPECT_EQ(it.policy.on_lost, Reaction::kZero);
  EXPECT_TRUE(it.policy.one_cycle_delay);
  EXPECT_TRUE(it.policy.fan_in);
}

TEST(Document, PortsMayShareTheNameOfAConnection) {
  const Loaded loaded = load_yaml(
      "components: {A: {model: M}, B: {model: M}}\n"
      "connections:\n"
      "  - {name: bus, ports: [B.In, A.Out], policy: {fifo: 2}}\n");
  EXPECT_EQ(loaded.messages(), "");
  const NamedConnection& named = loaded.document.named_connections.at(0);
  EXPECT_EQ(named.name, "bus");
  EXPECT_EQ(named.policy.capacity, 2u);
  ASSERT_EQ(named.ports.size(), 2u);
  EXPECT_EQ(named.ports[0].component, "A") << "ports are in the order of their components";
}

TEST(Document, ScriptsMayBeGrantedActsOfTheOperator) {
  const Loaded loaded = load_yaml("grants: {script: [Arming.arm, left.Arming.arm]}\n");
  EXPECT_EQ(loaded.messages(), "");
  ASSERT_EQ(loaded.document.script_grants.size(), 2u);
  EXPECT_EQ(loaded.document.script_grants[0].component, "Arming");
  EXPECT_EQ(loaded.document.script_grants[0].operation, "arm");
  EXPECT_EQ(loaded.document.script_grants[1].component, "left.Arming");
}

TEST(Document, GrantsOnHardwareAreSaidAsSuch) {
  const Loaded loaded = load_yaml("grants: {script: [Arming.arm], on_hardware: true}\n");
  EXPECT_EQ(loaded.messages(), "");
  EXPECT_TRUE(loaded.document.grants_on_hardware);
  EXPECT_FALSE(load_yaml("grants: {script: [Arming.arm]}\n").document.grants_on_hardware);
}

TEST(Document, AnchorsAndMergedMapsAreRead) {
  const Loaded loaded = load_yaml(
      "components:\n"
      "  A: &a {model: M, properties: {x: 1}}\n"
      "  B: *a\n"
      "  C: {<<: *a, model: N}\n");
  EXPECT_EQ(loaded.messages(), "");
  ASSERT_EQ(loaded.document.components.size(), 3u);
  EXPECT_EQ(loaded.document.components[1].model, "M");
  EXPECT_EQ(loaded.document.components[2].model, "N");
  EXPECT_EQ(loaded.document.components[2].properties.at(0).value.text, "1");
}

TEST(Document, WindowsLineEndsAndByteOrderMarkAreRead) {
  const Loaded loaded = load_yaml(
      "\xef\xbb\xbf"
      "components:\r\n  A: {model: M}\r\n");
  EXPECT_EQ(loaded.messages(), "");
  EXPECT_EQ(loaded.document.components.at(0).model, "M");
}

TEST(Document, DurationsAreWrittenExactly) {
  EXPECT_EQ(to_text(base::Duration(milliseconds(10))), "10 ms");
  EXPECT_EQ(to_text(base::Duration(milliseconds(1500))), "1500 ms");
  EXPECT_EQ(to_text(base::Duration(std::chrono::seconds(2))), "2 s");
  EXPECT_EQ(to_text(base::Duration(microseconds(250))), "250 us");
  EXPECT_EQ(to_text(base::Duration(1001)), "1001 ns");
}

TEST(Document, PathsCountFromItsFolder) {
  Document document;
  document.file = "robots/janus/head.yaml";
  EXPECT_EQ(path_from(document, "a.cpf"), "robots/janus/a.cpf");
  EXPECT_EQ(path_from(document, "/etc/a.cpf"), "/etc/a.cpf");
}

}  // namespace
}  // namespace armature::deploy
