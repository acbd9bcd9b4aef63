// SPDX-License-Identifier: Apache-2.0
// What is written reads back as the same document, in either format.
#include <gtest/gtest.h>

#include "armature/deploy/internal/document_in_memory.hpp"
#include "armature/orocos/deployer_file.hpp"

namespace armature::deploy {

using namespace orocos;

using namespace document;
namespace {

using internal::load_xml;
using internal::load_yaml;
using internal::Loaded;

constexpr const char* kEverything = R"(
application: everything
on_fault: stop_all
black_box: {history: 5 s, memory_kB: 200}
threads: 100
priorities: rtai
accept: [priority_inversion, missing_cpu]
operator_inputs: [C.Raw]
libraries: [robot, ./local.so]
parameters: {joints: 2, gains: [1.0, 2]}
components:
  S:
    model: Sampler
    activity: {periodic: 10 ms, scheduler: deadline, cpus: [1, 40], budget: 200 us,
               overrun: {fault: 3}, thread: fast}
    autosave: true
    property_file: [a.cpf, {file: b.cpf, complete: true}]
  J{1..${joints}}:
    model: "OCL::Joint"
    peers: ["S", {card: C}]
    bind: {read: C.sensorRead}
    delays: S
    properties: {Name: "j{i}", Gains: "${gains}", m: !literal "{i} ${x} {1..2}", t: !short 3,
                 s: {x: "a\tb\n", y: [], z: "<&>"}, e: "", n: "null", d: 10.0, q: 5 deg,
                 list: [[1, 2], {a: -1}], texts: [a, "b c"], kinds: [!char 1, 2, b],
                 chars: !strings [!char 1, 2], f: !orocos:KDL.Frame {x: .5}}
  R: {model: Motor, remote: tcp://robot/Motor}
  V: {remote: tcp://robot/Vision, interface: vision.idl#Vision}
  C: {model: Card, activity: {triggered: true, scheduler: realtime, priority: 3}, autostart: false}
  left: {model: Chassis, properties: {size: 3}}
composites:
  Chassis:
    parameters: {size: 1}
    components: {"m{1..${size}}": {model: Motor}, d: {model: Drive, peers: ["m{1..${size}}"]}}
    connections: ["m{i}.Speed -> d.In{i}", "m{i}.Out -> m{i+1}.In"]
    exports:
      ports: {Velocity: m1.Speed}
      operations: {go: d.go}
connections:
  - J{i}.Position -> S.Position{i}
  - {from: left.Velocity, to: S.v, policy: {fifo: 8, overflow: drop_oldest}, max_age: 30 ms,
     on_old: stop, on_lost: zero}
  - {from: S.a, to: C.a, delay: one_cycle}
  - {from: S.a, to: C.b}
  - {from: S.a, to: J1.b}
  - {from: J1.many, to: C.all, fan_in: true}
  - {from: J2.many, to: C.all, fan_in: true}
  - {name: bus, ports: [S.x, C.x, J1.x], policy: {fifo: 2}}
grants: {script: [S.arm, left.d.go], remote: [S.arm]}
before_stop: [S.rest, left.d.go]
network: {listen: [tcp://127.0.0.1:4242], policy: a.policy, pages: site, memory_kB: 32000, socket_mode: "0660", serving: {most: 20, least: 10}, tls: {certificate: c.pem, key: k.pem, authority: a.pem},
  inputs: [S.b, {to: left.d.c, max_age: 100 ms, on_old: zero}]}
modes: {one: ["J{1..2}", left], two: [C, J1]}
mode: two
)";

TEST(RoundTrip, YamlIsTheSameAgain) {
  const Loaded first = load_yaml(kEverything);
  ASSERT_EQ(first.messages(), "");
  const Loaded second = load_yaml(first.yaml());
  EXPECT_EQ(second.messages(), "");
  EXPECT_EQ(second.yaml(), first.yaml());
}

TEST(RoundTrip, ThroughXmlIsTheSameAgain) {
  const Loaded first = load_yaml(kEverything);
  base::Diagnostics notes;
  const Loaded second = load_xml(write_xml(first.document, notes));
  EXPECT_EQ(second.messages(), "");
  EXPECT_EQ(second.yaml(), first.yaml());
}

TEST(RoundTrip, XmlThroughYamlIsTheSameAgain) {
  base::Diagnostics notes;
  const std::string xml = write_xml(load_yaml(kEverything).document, notes);
  const Loaded through = load_yaml(load_xml(xml).yaml());
  EXPECT_EQ(through.messages(), "");
  EXPECT_EQ(write_xml(through.document, notes), xml);
}

TEST(RoundTrip, KeepsComponentsInTheirOrder) {
  const Loaded first = load_yaml(kEverything);
  base::Diagnostics notes;
  const Loaded second = load_xml(write_xml(first.document, notes));
  ASSERT_EQ(second.document.components.size(), first.document.components.size());
  for (std::size_t i = 0; i < first.document.components.size(); ++i) {
    EXPECT_EQ(second.document.components[i].name, first.document.components[i].name);
  }
}

TEST(WriteYaml, UsesShortForms) {
  EXPECT_EQ(load_yaml("components:\n"
                      "  A: {model: M, activity: {triggered: true}, peers: B}\n"
                      "connections:\n"
                      "  - {from: A.Out, to: B.In, policy: latest}\n"
                      "  - {from: A.Out, to: C.In, max_age: 0.03 s}\n")
                .yaml(),
            "components:\n"
            "  A:\n"
            "    model: M\n"
            "    activity: triggered\n"
            "    peers: [B]\n"
            "connections:\n"
            "  - A.Out -> B.In\n"
            "  - {from: A.Out, to: C.In, max_age: 30 ms}\n");
}

TEST(WriteYaml, BreaksLongLines) {
  const std::string long_text(60, 'x');
  const Loaded loaded = load_yaml("components: {A: {model: M, properties: {a: " + long_text +
                                  ", b: " + long_text + "}}}\n");
  EXPECT_EQ(loaded.yaml(),
            "components:\n  A:\n    model: M\n    activity: sequential\n"
            "    properties:\n      a: " +
                long_text + "\n      b: " + long_text + "\n");
}

TEST(WriteYaml, QuotesWhatYamlWouldReadOtherwise) {
  const auto written = [](const std::string& text) {
    Value value;
    value.kind = Value::Kind::kText;
    value.text = text;
    return to_text(value);
  };
  EXPECT_EQ(written("plain text-1.5/x"), "plain text-1.5/x");
  EXPECT_EQ(written("-1.5"), "-1.5");
  for (const char* text :
       {"",    " a",  "a ",  "a: b", "a #b", "- a", "*a", "&a", "!a", "null", "~",
        "[a]", "{a}", "a,b", "'a'",  "a\"b", "...", "%a", "@a", "`a", "|",    ">"}) {
    EXPECT_EQ(written(text).front(), '"') << text;
  }
  EXPECT_EQ(written("a\"b\\c\n\x01"), "\"a\\\"b\\\\c\\n\\x01\"");
  EXPECT_EQ(written("{i}"), "!literal \"{i}\"");
}

TEST(WriteXml, SaysWhatOrocosIgnores) {
  const Loaded loaded = load_yaml(
      "application: x\n"
      "components: {A: {model: M}, B: {model: M}}\n"
      "connections:\n"
      "  - {from: A.Out, to: B.In, max_age: 1 ms}\n"
      "  - {from: A.Oot, to: B.Inn, max_age: 2 ms}\n");
  base::Diagnostics notes;
  write_xml(loaded.document, notes);
  EXPECT_EQ(notes.to_text(),
            "robot.yaml: note: OROCOS ignores armature:application (1 place)\n"
            "robot.yaml: note: OROCOS ignores armature:max_age (2 places)\n");
}

TEST(WriteXml, IsPlainOrocosForWhatOrocosKnows) {
  const Loaded loaded = load_yaml(
      "libraries: lib\n"
      "components:\n"
      "  A: {model: M, activity: {periodic: 1 ms, priority: 5, cpus: [0, 1]}, peers: B,\n"
      "      properties: {x: 1.5, n: 3, b: true, t: text, v: [1, 2]}}\n"
      "  B: {model: N, autostart: false}\n"
      "connections:\n"
      "  - {name: c, ports: [A.Out, B.In], policy: {fifo: 2}}\n");
  base::Diagnostics notes;
  EXPECT_EQ(write_xml(loaded.document, notes), R"(<?xml version="1.0" encoding="UTF-8"?>
<!DOCTYPE properties SYSTEM "cpf.dtd">
<properties xmlns:armature="urn:armature:deployment">
  <simple name="Import" type="string"><value>lib</value></simple>
  <struct name="c" type="ConnPolicy">
    <simple name="type" type="short"><value>1</value></simple>
    <simple name="size" type="short"><value>2</value></simple>
  </struct>
  <struct name="A" type="M">
    <struct name="Activity" type="PeriodicActivity">
      <simple name="Period" type="double"><value>0.001</value></simple>
      <simple name="Priority" type="short"><value>5</value></simple>
      <simple name="CpuAffinity" type="ulong"><value>3</value></simple>
    </struct>
    <simple name="AutoConf" type="boolean"><value>1</value></simple>
    <simple name="AutoStart" type="boolean"><value>1</value></simple>
    <struct name="Peers" type="PropertyBag">
      <simple type="string"><value>B</value></simple>
    </struct>
    <struct name="Ports" type="PropertyBag">
      <simple name="Out" type="string"><value>c</value></simple>
    </struct>
    <struct name="Properties" type="PropertyBag">
      <simple name="x" type="double"><value>1.5</value></simple>
      <simple name="n" type="long"><value>3</value></simple>
      <simple name="b" type="boolean"><value>true</value></simple>
      <simple name="t" type="string"><value>text</value></simple>
      <struct name="v" type="array">
        <simple name="Element0" type="double"><value>1</value></simple>
        <simple name="Element1" type="double"><value>2</value></simple>
      </struct>
    </struct>
  </struct>
  <struct name="B" type="N">
    <struct name="Activity" type="SequentialActivity">
    </struct>
    <simple name="AutoConf" type="boolean"><value>1</value></simple>
    <simple name="AutoStart" type="boolean"><value>0</value></simple>
    <struct name="Ports" type="PropertyBag">
      <simple name="In" type="string"><value>c</value></simple>
    </struct>
  </struct>
</properties>
)");
  EXPECT_EQ(notes.to_text(), "");
}

TEST(WriteXml, RefusesWhatXmlCannotSay) {
  base::Diagnostics diagnostics;
  write_xml(load_yaml("components: {A: {model: M, properties: {x: \"\\x01\"}}}\n").document,
            diagnostics);
  EXPECT_EQ(diagnostics.to_text(),
            "robot.yaml: error: a text has control characters, which XML cannot contain\n");
}

TEST(WriteXml, RefusesPortsOfNoComponent) {
  base::Diagnostics diagnostics;
  write_xml(load_yaml("components: {A: {model: M}}\nconnections: [A.Out -> B.In]\n").document,
            diagnostics);
  EXPECT_EQ(diagnostics.to_text(),
            "robot.yaml:2:24: error: port 'B.In' cannot be written: unknown component 'B'\n");
}

}  // namespace
}  // namespace armature::deploy
