// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "armature/deploy/internal/document_in_memory.hpp"

namespace armature::deploy {

using namespace document;
namespace {

using internal::load_xml;
using internal::load_xml_body;
using internal::Loaded;

Component component(const std::string& content, const std::string& attributes = "") {
  const Loaded loaded =
      load_xml_body("<struct name=\"A\" type=\"M\" " + attributes + ">" + content + "</struct>");
  EXPECT_EQ(loaded.messages(), "");
  return loaded.document.components.at(0);
}

Activity activity(const std::string& type, const std::string& content,
                  const std::string& attributes = "") {
  return component("<struct name=\"Activity\" type=\"" + type + "\" " + attributes + ">" + content +
                   "</struct>")
      .activity;
}

std::string simple(const std::string& name, const std::string& type, const std::string& value) {
  return "<simple name=\"" + name + "\" type=\"" + type + "\"><value>" + value +
         "</value></simple>";
}

TEST(OrocosXml, ReadsADeployerFile) {
  const Loaded loaded = load_xml(R"(<?xml version="1.0" encoding="UTF-8"?>
<!DOCTYPE properties SYSTEM "cpf.dtd">
<properties>
  <simple name="Import" type="string"><value>janus</value></simple>
  <struct name="Fast" type="ConnPolicy">
    <simple name="type" type="short"><value>1</value></simple>
    <simple name="size" type="short"><value>12</value></simple>
  </struct>
  <struct name="Joint1" type="Joint">
    <struct name="Activity" type="PeriodicActivity">
      <simple name="Period" type="double"><value>0.01</value></simple>
      <simple name="Priority" type="short"><value>80</value></simple>
      <simple name="Scheduler" type="string"><value>ORO_SCHED_RT</value></simple>
      <simple name="CpuAffinity" type="ushort"><value>5</value></simple>
    </struct>
    <struct name="Peers" type="PropertyBag">
      <simple type="string"><value>aic1</value></simple>
    </struct>
    <struct name="Ports" type="PropertyBag">
      <simple name="Position" type="string"><value>Fast</value></simple>
      <simple name="Index" type="string"><value>Slow</value></simple>
    </struct>
    <struct name="Properties" type="PropertyBag">
      <simple name="GearRatio" type="double"><description>x</description><value>100</value></simple>
    </struct>
    <simple name="UpdateProperties" type="string"><value>joint.cpf</value></simple>
    <simple name="AutoConf" type="boolean"><value>1</value></simple>
    <simple name="AutoStart" type="boolean"><value>1</value></simple>
    <simple name="AutoSave" type="boolean"><value>1</value></simple>
  </struct>
  <struct name="Sensor" type="SensorNMux">
    <struct name="Activity" type="SequentialActivity"/>
    <struct name="Ports" type="PropertyBag">
      <simple name="Position1" type="string"><value>Fast</value></simple>
      <simple name="Index1" type="string"><value>Slow</value></simple>
    </struct>
  </struct>
</properties>
)");
  EXPECT_EQ(loaded.messages(), "");
  EXPECT_EQ(loaded.yaml(),
            "libraries: [janus]\n"
            "components:\n"
            "  Joint1:\n"
            "    model: Joint\n"
            "    activity: {periodic: 10 ms, priority: 80, scheduler: realtime, cpus: [0, 2]}\n"
            "    peers: [aic1]\n"
            "    property_file: [joint.cpf]\n"
            "    properties: {GearRatio: 100.0}\n"
            "    autosave: true\n"
            "  Sensor:\n"
            "    model: SensorNMux\n"
            "    activity: sequential\n"
            "    autoconf: false\n"
            "    autostart: false\n"
            "connections:\n"
            "  - {name: Fast, ports: [Joint1.Position, Sensor.Position1], policy: {fifo: 12}}\n"
            "  - {name: Slow, ports: [Joint1.Index, Sensor.Index1]}\n");
}

TEST(OrocosXml, PlacesAreThoseOfTheElements) {
  const Loaded loaded = load_xml_body(
      "  <struct name=\"A\" type=\"M\">\r\n    <struct name=\"Peers\">"
      "<simple type=\"string\"><value>B</value></simple></struct>"
      "</struct>");
  EXPECT_EQ(loaded.document.components.at(0).where, (base::Location{"robot.xml", 2, 3}));
  EXPECT_EQ(loaded.document.components.at(0).peers.at(0).where,
            (base::Location{"robot.xml", 3, 26}));
}

TEST(OrocosXml, ActivityTypesAreThreeKinds) {
  EXPECT_EQ(activity("SequentialActivity", "").kind, Activity::Kind::kSequential);
  EXPECT_EQ(activity("NonPeriodicActivity", simple("Priority", "short", "5")).kind,
            Activity::Kind::kTriggered);
  const std::string period = simple("Period", "double", "0.41");
  EXPECT_EQ(activity("Activity", period).period, std::chrono::milliseconds(410));
  EXPECT_EQ(activity("Activity", simple("Period", "double", "0.0")).kind,
            Activity::Kind::kTriggered);
  EXPECT_EQ(activity("Activity", "").kind, Activity::Kind::kTriggered);
}

TEST(OrocosXml, PriorityZeroIsNoPriority) {
  EXPECT_EQ(activity("Activity", simple("Priority", "short", "0")).priority, 0);
}

TEST(OrocosXml, StartsOnlyWhatItSays) {
  EXPECT_FALSE(component("").autostart);
  EXPECT_FALSE(component("").autoconf);
  const Component started = component(simple("AutoStart", "boolean", "1"));
  EXPECT_TRUE(started.autostart);
  EXPECT_TRUE(started.autoconf) << "what starts was configured";
}

TEST(OrocosXml, PropertyFilesAreCompleteOrPartial) {
  const Component it = component(simple("PropertyFile", "string", "all.cpf") +
                                 simple("UpdateProperties", "string", "some.cpf"));
  ASSERT_EQ(it.property_files.size(), 2u);
  EXPECT_TRUE(it.property_files[0].complete);
  EXPECT_FALSE(it.property_files[1].complete);
}

TEST(OrocosXml, TextsAreLiteral) {
  const Component it = component("<struct name=\"Properties\">" +
                                 simple("a", "string", "{i} {1..3} ${x}") + "</struct>");
  EXPECT_EQ(it.properties.at(0).value.text, "{i} {1..3} ${x}");
}

TEST(OrocosXml, LaterBagChangesAComponent) {
  const Loaded loaded = load_xml_body(
      "<struct name=\"A\" type=\"M\">" + simple("AutoStart", "boolean", "1") +
      "<struct name=\"Properties\">" + simple("x", "long", "1") + simple("y", "long", "2") +
      "</struct></struct>\n<struct name=\"A\" type=\"PropertyBag\">" +
      simple("AutoStart", "boolean", "0") + "<struct name=\"Properties\">" +
      simple("x", "long", "7") + "</struct></struct>");
  EXPECT_EQ(loaded.messages(), "");
  ASSERT_EQ(loaded.document.components.size(), 1u);
  const Component& it = loaded.document.components[0];
  EXPECT_FALSE(it.autostart);
  EXPECT_EQ(it.properties.at(0).value.text, "7");
  EXPECT_EQ(it.properties.at(1).value.text, "2");
}

TEST(OrocosXml, PolicyTypesAreNumbersOrNames) {
  const auto policy = [](const std::string& type_of_type, const std::string& type) {
    const Loaded loaded = load_xml_body(
        "<struct name=\"c\" type=\"ConnPolicy\">" + simple("type", type_of_type, type) +
        simple("size", "short", "4") + "</struct><struct name=\"A\" type=\"M\"><struct " +
        "name=\"Ports\">" + simple("x", "string", "c") + simple("y", "string", "c") +
        "</struct></struct>");
    EXPECT_EQ(loaded.messages(), "");
    const ConnectionPolicy& found = loaded.document.named_connections.at(0).policy;
    return (found.kind == ConnectionPolicy::Kind::kLatest ? "latest "
                                                          : std::to_string(found.capacity) + " ") +
           std::string(name_of(found.when_full));
  };
  EXPECT_EQ(policy("short", "0"), "latest drop_newest");
  EXPECT_EQ(policy("short", "1"), "4 drop_newest");
  EXPECT_EQ(policy("short", "2"), "4 drop_oldest");
  EXPECT_EQ(policy("string", "DATA"), "latest drop_newest");
  EXPECT_EQ(policy("string", "CIRCULAR_BUFFER"), "4 drop_oldest");
}

TEST(OrocosXml, DefaultPolicyIsThatOfConnectionsWithoutOwn) {
  const Loaded loaded =
      load_xml_body("<struct name=\"Default\" type=\"ConnPolicy\">" + simple("type", "short", "1") +
                    simple("size", "short", "3") +
                    "</struct><struct name=\"A\" type=\"M\"><struct " + "name=\"Ports\">" +
                    simple("x", "string", "c") + simple("y", "string", "c") + "</struct></struct>");
  EXPECT_EQ(loaded.document.named_connections.at(0).policy.capacity, 3u);
}

TEST(OrocosXml, AttributesSayWhatOrocosCannot) {
  const Component it = component(
      "<struct name=\"Activity\" type=\"PeriodicActivity\" armature:thread=\"fast\" "
      "armature:overrun=\"{fault: 3}\" armature:budget=\"1 ms\">" +
          simple("Period", "double", "0.01") +
          "</struct><struct name=\"Peers\"><simple armature:component=\"aic1\"><value>card</value>"
          "</simple></struct>",
      "armature:bind=\"{read: aic1.sensorRead}\" armature:delays=\"[B]\"");
  EXPECT_EQ(it.activity.thread, "fast");
  EXPECT_EQ(it.activity.late_cycles_to_fault, 3);
  EXPECT_EQ(it.peers.at(0).name, "card");
  EXPECT_EQ(it.peers.at(0).component, "aic1");
  EXPECT_EQ(it.bindings.at(0).member, "sensorRead");
  EXPECT_EQ(it.delays.at(0).name, "B");
}

struct Mistake {
  const char* name;
  const char* body;
  const char* message;
};

void PrintTo(const Mistake& mistake, std::ostream* stream) { *stream << mistake.name; }

class XmlMistakes : public testing::TestWithParam<Mistake> {};

TEST_P(XmlMistakes, AreReportedWithTheirPlaceAndRemedy) {
  EXPECT_EQ(load_xml_body(GetParam().body).messages(), GetParam().message);
}

std::string name_of(const testing::TestParamInfo<Mistake>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(
    OfStructure, XmlMistakes,
    testing::Values(
        Mistake{"end_tag", "<struct></simple>",
                "robot.xml:2:11: error: this is not XML: Start-end tags mismatch\n"},
        Mistake{"element", "<simpel name=\"Import\"/>",
                "robot.xml:2:1: error: unexpected element 'simpel' (did you mean 'simple'?)\n"},
        Mistake{"attribute", "<simple nam=\"Import\" type=\"string\"><value>x</value></simple>",
                "robot.xml:2:1: error: unknown attribute 'nam' (did you mean 'name'?)\n"
                "robot.xml:2:1: error: unknown simple '' (known: Import, Include)\n"},
        Mistake{"text", "hello", "robot.xml:1:13: error: text 'hello' outside <value>\n"},
        Mistake{"no_value", "<simple name=\"Import\" type=\"string\"/>",
                "robot.xml:2:1: error: simple 'Import' has no <value>\n"},
        Mistake{"character_reference",
                "<simple name=\"Import\" type=\"string\"><value>&#7;</value></simple>",
                "robot.xml:2:44: error: '&#7;' is not a character of XML (write & as &amp;)\n"},
        Mistake{"character_reference_to_nothing",
                "<simple name=\"Import\" type=\"string\"><value>a&#0;b</value></simple>",
                "robot.xml:2:45: error: '&#0;' is not a character of XML (write & as &amp;)\n"},
        Mistake{"character_reference_too_large",
                "<simple name=\"Import\" type=\"string\"><value>&#04294967361;</value></simple>",
                "robot.xml:2:44: error: '&#04294967361;' is not a character of XML (write & as "
                "&amp;)\n"},
        Mistake{"character_reference_to_a_surrogate",
                "<simple name=\"Im&#xD800;\" type=\"string\"><value>x</value></simple>",
                "robot.xml:2:17: error: '&#xD800;' is not a character of XML (write & as &amp;)\n"},
        Mistake{"character_reference_unfinished",
                "<simple name=\"Import\" type=\"string\"><value>R&#38 D</value></simple>",
                "robot.xml:2:45: error: '&#38' is not a character of XML (write & as &amp;)\n"}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    OfTheDocument, XmlMistakes,
    testing::Values(
        Mistake{"simple", "<simple name=\"Imports\" type=\"string\"><value>x</value></simple>",
                "robot.xml:2:1: error: unknown simple 'Imports' (did you mean 'Import'?)\n"},
        Mistake{"path", "<simple name=\"Path\" type=\"string\"><value>/lib</value></simple>",
                "robot.xml:2:1: error: Path '/lib' is not supported: folders of libraries are "
                "given at start (remove it, and write armature run -L '/lib', or import the "
                "libraries by their own "
                "paths)\n"},
        Mistake{"nameless", "<struct type=\"M\"/>",
                "robot.xml:2:1: error: a component's struct needs a name (add name=\"...\")\n"},
        Mistake{"no_model", "<struct name=\"A\" type=\"PropertyBag\"/>",
                "robot.xml:2:1: error: component 'A': type must be a component model (type "
                "PropertyBag only changes a component that is listed before)\n"},
        Mistake{"twice", "<struct name=\"A\" type=\"M\"/>\n<struct name=\"A\" type=\"N\"/>",
                "robot.xml:3:1: error: component 'A' is given twice (first at robot.xml:2:1; type "
                "PropertyBag changes a component that is listed before)\n"}),
    name_of);

#define COMPONENT(content) "<struct name=\"A\" type=\"M\">\n" content "</struct>"
#define SIMPLE(name, type, value) \
  "<simple name=\"" name "\" type=\"" type "\"><value>" value "</value></simple>\n"
#define STRUCT(name, type, content) \
  "<struct name=\"" name "\" type=\"" type "\">\n" content "</struct>\n"

INSTANTIATE_TEST_SUITE_P(
    OfAComponent, XmlMistakes,
    testing::Values(
        Mistake{"simple", COMPONENT(SIMPLE("AutoStrat", "boolean", "1")),
                "robot.xml:3:1: error: component 'A': unknown simple 'AutoStrat' (did you mean "
                "'AutoStart'?)\n"},
        Mistake{"bag", COMPONENT(STRUCT("Port", "PropertyBag", "")),
                "robot.xml:3:1: error: component 'A': unknown struct 'Port' (did you mean "
                "'Ports'?)\n"},
        Mistake{"boolean", COMPONENT(SIMPLE("AutoSave", "boolean", "maybe")),
                "robot.xml:3:1: error: simple 'AutoSave' of type boolean must be 0, 1, true or "
                "false, found 'maybe'\n"
                "robot.xml:3:1: error: component 'A': autosave must be true or false, found "
                "'maybe'\n"},
        Mistake{"service", COMPONENT(SIMPLE("Service", "string", "marshalling")),
                "robot.xml:3:1: warning: component 'A': service 'marshalling' is left out: "
                "Armature has no services [service_left_out]\n"},
        Mistake{"script", COMPONENT(SIMPLE("RunScript", "string", "a.ops")),
                "robot.xml:3:1: error: component 'A': OROCOS script 'a.ops' cannot run here "
                "(remove it, rewrite it in Lua and start that with armature run --script)\n"},
        Mistake{"autoconnect", COMPONENT(SIMPLE("AutoConnect", "boolean", "1")),
                "robot.xml:3:1: error: component 'A': AutoConnect is not supported (list the ports "
                "under Ports)\n"},
        Mistake{"load", COMPONENT(SIMPLE("LoadProperties", "string", "a.cpf")),
                "robot.xml:3:1: note: component 'A': LoadProperties is read as UpdateProperties: "
                "no property is created\n"},
        Mistake{"activity", COMPONENT(STRUCT("Activity", "PeriodcActivity", "")),
                "robot.xml:3:1: error: component 'A': unknown activity 'PeriodcActivity' (did you "
                "mean 'PeriodicActivity'?)\n"},
        Mistake{"period", COMPONENT(STRUCT("Activity", "PeriodicActivity", "")),
                "robot.xml:3:1: error: component 'A': a PeriodicActivity needs its Period\n"},
        Mistake{"period_of_zero",
                COMPONENT(STRUCT("Activity", "PeriodicActivity", SIMPLE("Period", "double", "0"))),
                "robot.xml:4:1: error: component 'A': periodic must be a duration above 0, "
                "found '0.0 s' (for example 10 ms)\n"},
        Mistake{"scheduler",
                COMPONENT(STRUCT("Activity", "Activity", SIMPLE("Scheduler", "string", "RT"))),
                "robot.xml:4:1: error: component 'A': Scheduler must be ORO_SCHED_RT or "
                "ORO_SCHED_OTHER, found 'RT'\n"},
        Mistake{"affinity",
                COMPONENT(STRUCT("Activity", "Activity", SIMPLE("CpuAffinity", "ulong", "0"))),
                "robot.xml:4:1: error: component 'A': CpuAffinity must have at least one bit "
                "set\n"},
        Mistake{"priority",
                COMPONENT(STRUCT("Activity", "Activity", SIMPLE("Priority", "short", "200"))),
                "robot.xml:4:1: error: component 'A': priority must be a whole number from 1 to "
                "99, found '200'\n"},
        Mistake{"setting", COMPONENT(STRUCT("Activity", "Activity", SIMPLE("Prio", "short", "2"))),
                "robot.xml:4:1: error: component 'A': unknown setting 'Prio' of an activity "
                "(known: Period, Priority, Scheduler, CpuAffinity)\n"},
        Mistake{
            "priority_without_thread",
            COMPONENT(STRUCT("Activity", "SequentialActivity", SIMPLE("Priority", "short", "2"))),
            "robot.xml:4:1: warning: component 'A': Priority is left out: a sequential "
            "activity has none [setting_left_out]\n"},
        Mistake{"port_without_connection",
                COMPONENT(STRUCT("Ports", "PropertyBag", SIMPLE("x", "string", ""))),
                "robot.xml:4:1: error: component 'A': an entry of Ports needs the name of a port, "
                "and the name of a connection as its value\n"},
        Mistake{"single_port",
                COMPONENT(STRUCT("Ports", "PropertyBag", SIMPLE("x", "string", "c"))),
                "robot.xml:4:1: error: connection 'c': only one port has this name; nothing is "
                "connected\n"}),
    name_of);

#define POLICY(attributes, content)                                                           \
  "<struct name=\"c\" type=\"ConnPolicy\" " attributes ">\n" content "</struct>\n" COMPONENT( \
      STRUCT("Ports", "PropertyBag", SIMPLE("x", "string", "c") SIMPLE("y", "string", "c")))

INSTANTIATE_TEST_SUITE_P(
    OfAPolicy, XmlMistakes,
    testing::Values(
        Mistake{"type", POLICY("", SIMPLE("type", "short", "7")),
                "robot.xml:2:1: error: connection 'c': type must be 0 (DATA), 1 (BUFFER) or 2 "
                "(CIRCULAR_BUFFER), found '7'\n"},
        Mistake{"size", POLICY("", SIMPLE("type", "short", "1") SIMPLE("size", "short", "0")),
                "robot.xml:2:1: error: connection: fifo must be a whole number from 1 to 1000000, "
                "found '0'\n"},
        Mistake{"transport", POLICY("", SIMPLE("transport", "long", "1")),
                "robot.xml:3:1: error: connection 'c': transport 1 is not supported (write 0: "
                "connections stay inside the process)\n"},
        Mistake{"lock", POLICY("", SIMPLE("lock_policy", "long", "1")),
                "robot.xml:3:1: note: connection 'c': lock_policy is left out: it has no effect "
                "here\n"},
        Mistake{"buffer", POLICY("", SIMPLE("buffer_policy", "long", "4")),
                "robot.xml:3:1: note: connection 'c': buffer_policy is left out: the connection "
                "has no buffer\n"},
        Mistake{"field", POLICY("", SIMPLE("sise", "long", "4")),
                "robot.xml:3:1: error: connection 'c': unknown field 'sise' (did you mean "
                "'size'?)\n"},
        Mistake{"other_ports", POLICY("armature:from=\"A.x\" armature:to=\"A.z\"", ""),
                "robot.xml:2:1: error: connection 'c': armature:from and armature:to name other "
                "ports than the structs Ports of the components (change both, or remove "
                "armature:from and armature:to)\n"},
        Mistake{"unused", "<struct name=\"c\" type=\"ConnPolicy\"/>",
                "robot.xml:2:1: warning: connection 'c' has no ports [unused_connection]\n"},
        Mistake{"extension", POLICY("armature:max_aeg=\"1 ms\"", ""),
                "robot.xml:2:1: error: connection: unknown key 'max_aeg' (did you mean "
                "'max_age'?)\n"}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    OfAProperty, XmlMistakes,
    testing::Values(
        Mistake{"type", COMPONENT(STRUCT("Properties", "PropertyBag", SIMPLE("x", "int", "1"))),
                "robot.xml:4:1: error: simple 'x': unknown type 'int' (for example long, double, "
                "boolean or string)\n"},
        Mistake{"number",
                COMPONENT(STRUCT("Properties", "PropertyBag", SIMPLE("x", "long", "1.5"))),
                "robot.xml:4:1: error: simple 'x' of type long must be a whole number, found "
                "'1.5'\n"},
        Mistake{"twice",
                COMPONENT(STRUCT("Properties", "PropertyBag",
                                 SIMPLE("x", "long", "1") SIMPLE("x", "long", "2"))),
                "robot.xml:5:1: error: 'x' is given twice (first at robot.xml:4:1)\n"},
        Mistake{"element",
                COMPONENT(STRUCT("Properties", "PropertyBag",
                                 STRUCT("v", "array", SIMPLE("Element0", "double", "a")))),
                "robot.xml:5:1: error: an element of the list must be a number, found 'a'\n"},
        Mistake{"struct_type",
                COMPONENT(STRUCT("Properties", "PropertyBag", STRUCT("v", "a b", ""))),
                "robot.xml:4:1: error: struct 'v': unknown type 'a b' (for example PropertyBag or "
                "array)\n"}),
    name_of);

TEST(OrocosXml, RootMustBeOneElementProperties) {
  EXPECT_EQ(load_xml("<propertys/>").messages(),
            "robot.xml:1:1: error: the file must have one element 'properties', found "
            "'propertys'\n");
  EXPECT_EQ(load_xml("<properties/>\n<properties/>").messages(),
            "robot.xml:2:1: error: the file must have one element 'properties', found "
            "'properties'\n");
  EXPECT_EQ(load_xml("").messages(),
            "robot.xml:1:1: error: this is not XML: No document element "
            "found\n");
}

TEST(OrocosXml, RootAttributesAreKnownByName) {
  EXPECT_EQ(load_xml("<properties armature:aplication=\"x\"/>").messages(),
            "robot.xml:1:1: error: unknown attribute 'armature:aplication' (did you mean "
            "'application'?)\n");
}

}  // namespace
}  // namespace armature::deploy
