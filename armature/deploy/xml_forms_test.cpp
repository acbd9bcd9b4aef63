// SPDX-License-Identifier: Apache-2.0
// Forms of OROCOS files that OCL reads: what is read as what, and what is said about the rest.
#include <chrono>

#include <gtest/gtest.h>

#include "armature/deploy/internal/document_in_memory.hpp"

namespace armature::deploy {

using namespace document;
namespace {

using internal::load_files;
using internal::load_xml_body;
using internal::Loaded;

std::string simple(const std::string& name, const std::string& type, const std::string& value) {
  return "<simple name=\"" + name + "\" type=\"" + type + "\"><value>" + value +
         "</value></simple>";
}

std::string component(const std::string& name, const std::string& content) {
  return "<struct name=\"" + name + "\" type=\"M\">" + content + "</struct>\n";
}

std::string activity(const std::string& type, const std::string& content) {
  return "<struct name=\"Activity\" type=\"" + type + "\">" + content + "</struct>";
}

std::string bag(const std::string& content) {
  return "<struct name=\"Properties\"><struct name=\"B\" type=\"PropertyBag\">" + content +
         "</struct></struct>";
}

TEST(OrocosForms, ADeploymentMayBeCalledCpf) {
  const Loaded loaded = load_files(
      "robot.cpf", {{"robot.cpf", "<properties>" + component("A", "") + "</properties>"}});
  EXPECT_EQ(loaded.messages(), "");
  ASSERT_EQ(loaded.document.components.size(), 1u);
  EXPECT_EQ(loaded.document.components[0].name, "A");
}

TEST(OrocosForms, AnIncludeIsRelativeToItsFileOrElseToTheWorkingDirectory) {
  const std::string include = simple("Include", "string", "data/part.xml");
  const std::string robot = "<properties>" + include + "</properties>";
  const auto part = [](const std::string& name) {
    return "<properties>" + component(name, "") + "</properties>";
  };
  const auto first = [](const Loaded& loaded) {
    EXPECT_EQ(loaded.messages(), "");
    return loaded.document.components.empty() ? "" : loaded.document.components[0].name;
  };
  EXPECT_EQ(first(load_files("data/robot.xml",
                             {{"data/robot.xml", robot}, {"data/part.xml", part("Here")}})),
            "Here");
  EXPECT_EQ(first(load_files("data/robot.xml", {{"data/robot.xml", robot},
                                                {"data/part.xml", part("Here")},
                                                {"data/data/part.xml", part("Beside")}})),
            "Beside");
}

TEST(OrocosForms, AYamlFileIncludesOnlyRelativeToItself) {
  EXPECT_EQ(load_files("data/robot.yaml", {{"data/robot.yaml", "include: part.yaml\n"},
                                           {"part.yaml", "components: {A: {model: M}}\n"}})
                .messages(),
            "data/robot.yaml:1:10: error: file 'data/part.yaml' does not exist\n");
}

TEST(OrocosForms, EntriesOfOneNameAreAList) {
  const Loaded loaded = load_xml_body(
      component("A", bag(simple("Port", "string", "J1.Out") + simple("Port", "string", "J2.Out"))));
  EXPECT_EQ(loaded.messages(), "");
  EXPECT_EQ(to_text(loaded.document.components.at(0).properties.at(0).value), "[J1.Out, J2.Out]");
}

TEST(OrocosForms, EntriesWithoutANameAreAList) {
  const Loaded loaded = load_xml_body(
      component("A", bag("<simple type=\"string\"><value>x</value></simple>"
                         "<simple name=\"\" type=\"string\"><value>y</value></simple>")));
  EXPECT_EQ(loaded.messages(), "");
  EXPECT_EQ(to_text(loaded.document.components.at(0).properties.at(0).value), "[x, y]");
}

TEST(OrocosForms, NamesThatAreLeftOutAreTold) {
  const Loaded loaded = load_xml_body(
      component("A", bag(simple("Component", "string", "J1") + simple("Port", "string", "J2.Out") +
                         simple("Port", "string", "J3.Out"))));
  EXPECT_EQ(loaded.messages(),
            "robot.xml:2:53: warning: struct 'B' has entries of the same name or without one: it "
            "is read as the list of their values, names are left out [names_left_out]\n");
  EXPECT_EQ(to_text(loaded.document.components.at(0).properties.at(0).value),
            "[J1, J2.Out, J3.Out]");
}

TEST(OrocosForms, TwoPropertiesOfOneNameAreRefused) {
  EXPECT_EQ(
      load_xml_body(component("A", "<struct name=\"Properties\">" + simple("Gain", "double", "1") +
                                       simple("Gain", "double", "2") + "</struct>"))
          .messages(),
      "robot.xml:2:112: error: 'Gain' is given twice (first at robot.xml:2:53)\n");
}

TEST(OrocosForms, ASlaveHasTheActivityOfItsMasterInItsThread) {
  const Loaded loaded = load_xml_body(
      component("S", activity("SlaveActivity", simple("Master", "string", "M"))) +
      component("M", activity("PeriodicActivity", simple("Period", "double", "0.01") +
                                                      simple("Priority", "short", "70"))) +
      component("T", activity("SlaveActivity", simple("Master", "string", "S"))));
  EXPECT_EQ(loaded.messages(),
            "robot.xml:2:27: note: component 'S': SlaveActivity is read as the activity of 'M' in "
            "its thread, where writers run before readers\n"
            "robot.xml:4:27: note: component 'T': SlaveActivity is read as the activity of 'S' in "
            "its thread, where writers run before readers\n");
  ASSERT_EQ(loaded.document.components.size(), 3u);
  for (const Component& each : loaded.document.components) {
    EXPECT_EQ(each.activity.period, std::chrono::milliseconds(10)) << each.name;
    EXPECT_EQ(each.activity.priority, 70) << each.name;
    EXPECT_EQ(each.activity.thread, "M_thread") << each.name;
  }
}

TEST(OrocosForms, ASlaveWithoutMasterIsSequentialAndTold) {
  const Loaded loaded =
      load_xml_body(component("S", activity("SlaveActivity", simple("Period", "double", "0.01"))));
  EXPECT_EQ(loaded.messages(),
            "robot.xml:2:27: warning: component 'S': a SlaveActivity without Master is read as a "
            "SequentialActivity: it runs when data or a call arrives [slave_without_master]\n");
  EXPECT_EQ(loaded.document.components.at(0).activity.kind, Activity::Kind::kSequential);
}

TEST(OrocosForms, RealTimeHasAPriorityAndOtherThreadsHaveNone) {
  const auto with = [](const char* scheduler, const char* priority) {
    return load_xml_body(
        component("A", activity("Activity", simple("Period", "double", "0.01") +
                                                simple("Priority", "short", priority) +
                                                simple("Scheduler", "string", scheduler))));
  };
  const Loaded realtime = with("ORO_SCHED_RT", "0");
  EXPECT_EQ(realtime.document.components.at(0).activity.priority, 1);
  EXPECT_EQ(
      realtime.messages(),
      "robot.xml:2:27: warning: component 'A': Priority 0 of ORO_SCHED_RT is read as Priority "
      "1 [priority_changed]\n");
  const Loaded other = with("ORO_SCHED_OTHER", "5");
  EXPECT_EQ(other.document.components.at(0).activity.priority, 0);
  EXPECT_EQ(other.messages(),
            "robot.xml:2:27: warning: component 'A': Priority 5 is left out: threads of "
            "ORO_SCHED_OTHER have none [priority_changed]\n");
  EXPECT_EQ(with("ORO_SCHED_OTHER", "0").messages(), "");
}

TEST(OrocosForms, ABufferPolicyWithoutBufferIsLeftOut) {
  EXPECT_EQ(load_xml_body("<struct name=\"Default\" type=\"ConnPolicy\">" +
                          simple("buffer_policy", "long", "4") + simple("type", "long", "0") +
                          "</struct>")
                .messages(),
            "robot.xml:2:42: note: connection 'Default': buffer_policy is left out: the connection "
            "has no buffer\n");
}

}  // namespace
}  // namespace armature::deploy
