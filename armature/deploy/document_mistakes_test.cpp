// SPDX-License-Identifier: Apache-2.0
// Every kind of mistake in a YAML document and the text that answers it.
#include <gtest/gtest.h>

#include "armature/deploy/internal/document_in_memory.hpp"

namespace armature::deploy {

using namespace document;
namespace {

using internal::load_yaml;

struct Mistake {
  const char* name;
  const char* text;
  const char* message;
};

void PrintTo(const Mistake& mistake, std::ostream* stream) { *stream << mistake.name; }

class Mistakes : public testing::TestWithParam<Mistake> {};

TEST_P(Mistakes, AreReportedWithTheirPlaceAndRemedy) {
  EXPECT_EQ(load_yaml(GetParam().text).messages(), GetParam().message);
}

std::string name_of(const testing::TestParamInfo<Mistake>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(
    OfSyntax, Mistakes,
    testing::Values(
        Mistake{"tab", "components:\n\tA: {model: M}\n",
                "robot.yaml:2:3: error: this is not YAML: illegal map value (indent with spaces, "
                "not with tabs)\n"},
        Mistake{"unquoted_braces", "connections:\n  - {from: J{i}.Out, to: S.In}\n",
                "robot.yaml:2:13: error: this is not YAML: end of map flow not found (inside [ ] "
                "and { }, put text that contains braces in quotes)\n"},
        Mistake{"open_list", "libraries: [a, b\n",
                "robot.yaml:1:12: error: this is not YAML: the [ that opens here is not closed "
                "(what follows was read up to robot.yaml:2:1)\n"},
        Mistake{"open_quote", "libraries: [a, \"b]\n",
                "robot.yaml:1:16: error: this is not YAML: the \" that opens here is not closed "
                "(what follows was read up to robot.yaml:2:1)\n"},
        Mistake{"wrong_bracket", "a: [1, {b: 2]\n",
                "robot.yaml:1:8: error: this is not YAML: the { that opens here is not closed "
                "(what follows was read up to robot.yaml:1:13)\n"},
        Mistake{"apostrophe_is_no_quote", "application: it's\nlibraries: [a\n",
                "robot.yaml:2:12: error: this is not YAML: the [ that opens here is not closed "
                "(what follows was read up to robot.yaml:3:1)\n"},
        Mistake{"key_twice", "components:\n  A: {model: M}\n  A: {model: N}\n",
                "robot.yaml:3:3: error: 'A' is given twice (first at robot.yaml:2:3)\n"},
        Mistake{"unknown_anchor", "libraries: *all\n",
                "robot.yaml:1:12: error: this is not YAML: the referenced anchor is not defined\n"},
        Mistake{"alias_of_itself", "libraries: &a [x, *a]\n",
                "robot.yaml:1:19: error: the alias refers to the value that contains it\n"},
        Mistake{"key_that_is_a_list", "{[a]: b}\n", "robot.yaml:1:2: error: a key must be text\n"},
        Mistake{"merge_of_text", "{<<: a}\n",
                "robot.yaml:1:2: error: '<<' takes a map or a list of maps\n"},
        Mistake{"unknown_tag", "application: !latin x\n",
                "robot.yaml:1:14: error: unknown tag '!latin' (known: !literal and the types of "
                "OROCOS property files)\n"},
        Mistake{"second_document", "application: a\n---\napplication: b\n",
                "robot.yaml:2:1: error: a second document begins here (remove the line '---')\n"},
        Mistake{"list_as_document", "- a\n",
                "robot.yaml:1:1: error: document: expected a map of keys, found a list\n"},
        Mistake{"invalid_utf8", "application: a\nlibraries: [\xff]\n",
                "robot.yaml:2:13: error: byte 0xFF is not valid UTF-8 (save the file as UTF-8)\n"},
        Mistake{"control_character", "application: a\x07\n",
                "robot.yaml:1:15: error: control character 0x07 in a text file\n"}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    OfTheDocument, Mistakes,
    testing::Values(
        Mistake{"unknown_key", "aplication: x\n",
                "robot.yaml:1:1: error: document: unknown key 'aplication' (did you mean "
                "'application'?)\n"},
        Mistake{"components_as_list", "components: [A]\n",
                "robot.yaml:1:13: error: document: components must be a map, found a list\n"},
        Mistake{"connections_as_map", "connections: {A.Out: B.In}\n",
                "robot.yaml:1:14: error: document: connections must be a list, found a map\n"},
        Mistake{"fault_policy", "on_fault: stopall\n",
                "robot.yaml:1:11: error: document: on_fault must be stop_dependents, stop_all or "
                "keep_running, found 'stopall' (did you mean 'stop_all'?)\n"},
        Mistake{"library_as_map", "libraries: [{a: b}]\n",
                "robot.yaml:1:13: error: document: library must be text, found a map\n"},
        Mistake{"script", "scripts: a.lua\n",
                "robot.yaml:1:10: error: document: 'scripts' is not a section of a deployment: "
                "scripts are given at start (armature run FILE --script SCRIPT)\n"},
        Mistake{"recorder", "recorder: {to: x.csv}\n",
                "robot.yaml:1:11: error: document: 'recorder' is not a section of a deployment: a "
                "component of the model Reporter records (see docs/recording.md)\n"}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    OfAComponent, Mistakes,
    testing::Values(
        Mistake{"no_model", "components:\n  A: {}\n",
                "robot.yaml:2:3: error: component 'A': it has no model (write model: and a "
                "component model's name)\n"},
        Mistake{"text_in_place_of_keys", "components: {A: Joint}\n",
                "robot.yaml:1:14: error: component 'A': it has no model (write model: and a "
                "component model's name)\n"
                "robot.yaml:1:17: error: component 'A': expected a map of keys, found text\n"},
        Mistake{"unknown_key", "components: {A: {model: M, propertys: {}}}\n",
                "robot.yaml:1:28: error: component 'A': unknown key 'propertys' (did you mean "
                "'properties'?)\n"},
        Mistake{"name", "components: {1A: {model: M}}\n",
                "robot.yaml:1:14: error: component '1A' is not a valid name (a name has letters, "
                "digits, '_' and '-' and begins with a letter)\n"},
        Mistake{"flag", "components: {A: {model: M, autostart: yes}}\n",
                "robot.yaml:1:39: error: component 'A': autostart must be true or false, found "
                "'yes'\n"},
        Mistake{"start_without_configure", "components: {A: {model: M, autoconf: false}}\n",
                "robot.yaml:1:14: error: component 'A': autostart needs autoconf (set autoconf: "
                "true, or autostart: false)\n"},
        Mistake{"save_without_file", "components: {A: {model: M, autosave: true}}\n",
                "robot.yaml:1:14: error: component 'A': autosave needs a property_file (for "
                "example property_file: properties.cpf)\n"},
        Mistake{"properties_as_list", "components: {A: {model: M, properties: [x]}}\n",
                "robot.yaml:1:40: error: component 'A': properties must be a map, found a list\n"},
        Mistake{"property_without_value", "components: {A: {model: M, properties: {x: }}}\n",
                "robot.yaml:1:41: error: component 'A': property 'x' has no value (braces of {i} "
                "and ${name} need quotes; an empty text is \"\")\n"},
        Mistake{"property_with_unquoted_braces",
                "components: {A: {model: M, properties: {n: {i}}}}\n",
                "robot.yaml:1:45: error: component 'A': property 'n' has no value (braces of {i} "
                "and ${name} need quotes; an empty text is \"\")\n"},
        Mistake{"property_name", "components: {A: {model: M, properties: {a b: 1}}}\n",
                "robot.yaml:1:41: error: component 'A': property 'a b' is not a valid name\n"},
        Mistake{"peer_name", "components: {A: {model: M, peers: [B C]}}\n",
                "robot.yaml:1:36: error: component 'A': peer 'B C' is not a valid name (a name has "
                "letters, digits, '_' and '-' and begins with a letter)\n"},
        Mistake{"binding", "components: {A: {model: M, bind: {read: [x]}}}\n",
                "robot.yaml:1:41: error: component 'A': bind read must be text, found a list\n"},
        Mistake{"property_file", "components: {A: {model: M, property_file: {path: x}}}\n",
                "robot.yaml:1:43: error: component 'A': property_file has no 'file'\n"
                "robot.yaml:1:44: error: component 'A': unknown key 'path' (known: file, "
                "complete)\n"},
        Mistake{"twice_by_range", "components:\n  J2: {model: M}\n  J{1..2}: {model: M}\n",
                "robot.yaml:3:3: error: component 'J2' is given twice (first at robot.yaml:2:3; "
                "write override: true to change that one, remove: true to leave it out)\n"},
        Mistake{
            "override_of_nothing", "components: {A: {override: true}}\n",
            "robot.yaml:1:14: error: component 'A' is marked override: true but does not exist\n"}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    OfAnActivity, Mistakes,
    testing::Values(
        Mistake{"unknown_kind", "components: {A: {model: M, activity: trigered}}\n",
                "robot.yaml:1:38: error: component 'A': activity must be sequential or triggered, "
                "found 'trigered' (did you mean 'triggered'?)\n"},
        Mistake{"periodic_without_period", "components: {A: {model: M, activity: periodic}}\n",
                "robot.yaml:1:38: error: component 'A': a periodic activity needs its period (for "
                "example {periodic: 10 ms})\n"},
        Mistake{"two_kinds",
                "components: {A: {model: M, activity: {periodic: 1 ms, triggered: true}}}\n",
                "robot.yaml:1:38: error: component 'A': an activity is either periodic, triggered "
                "or sequential (keep one of these keys)\n"},
        Mistake{"triggered_false", "components: {A: {model: M, activity: {triggered: false}}}\n",
                "robot.yaml:1:50: error: component 'A': triggered can only be true (leave it out, "
                "or choose another activity)\n"},
        Mistake{"period_without_unit", "components: {A: {model: M, activity: {periodic: 10}}}\n",
                "robot.yaml:1:49: error: component 'A': periodic must be a duration with its unit, "
                "found '10' (for example 10 ms)\n"},
        Mistake{"period_of_another_kind",
                "components: {A: {model: M, activity: {periodic: 10 mm}}}\n",
                "robot.yaml:1:49: error: component 'A': periodic must be a duration, found '10 mm' "
                "(for example 10 ms)\n"},
        Mistake{"period_of_zero", "components: {A: {model: M, activity: {periodic: 0 ms}}}\n",
                "robot.yaml:1:49: error: component 'A': periodic must be a duration above 0, "
                "found '0 ms' (for example 10 ms)\n"},
        Mistake{"period_that_no_thread_keeps",
                "components: {A: {model: M, activity: {periodic: 9 us}}}\n",
                "robot.yaml:1:49: error: component 'A': periodic must be at least 10 us, found "
                "'9 us' (no thread keeps a shorter period)\n"},
        Mistake{"period_that_is_no_number",
                "components: {A: {model: M, activity: {periodic: nan s}}}\n",
                "robot.yaml:1:49: error: component 'A': periodic: expected a finite number, such "
                "as '0.5' or '10 ms', found 'nan s' (for example 10 ms)\n"},
        Mistake{"priority",
                "components: {A: {model: M, activity: {triggered: true, priority: 100}}}\n",
                "robot.yaml:1:66: error: component 'A': priority must be a whole number from 1 to "
                "99, found '100'\n"},
        Mistake{"scheduler",
                "components: {A: {model: M, activity: {triggered: true, scheduler: rt}}}\n",
                "robot.yaml:1:67: error: component 'A': scheduler must be other, realtime or "
                "deadline, found 'rt'\n"},
        Mistake{"cpu", "components: {A: {model: M, activity: {triggered: true, cpus: [0, x]}}}\n",
                "robot.yaml:1:66: error: component 'A': cpus must be a whole number from 0 to "
                "1023, found 'x'\n"},
        Mistake{"overrun",
                "components: {A: {model: M, activity: {periodic: 1 ms, overrun: ignore}}}\n",
                "robot.yaml:1:64: error: component 'A': overrun must be skip, catch_up or fault, "
                "found 'ignore'\n"},
        Mistake{"overrun_limit",
                "components: {A: {model: M, activity: {periodic: 1 ms, overrun: {fault: 0}}}}\n",
                "robot.yaml:1:72: error: component 'A': overrun fault must be a whole number from "
                "1 to 1000000, found '0'\n"},
        Mistake{"priority_without_thread",
                "components: {A: {model: M, activity: {sequential: true, priority: 9}}}\n",
                "robot.yaml:1:57: error: component 'A': priority does not apply to a sequential "
                "activity, "
                "which runs in the thread of the component that triggers it\n"},
        Mistake{"overrun_without_period",
                "components: {A: {model: M, activity: {triggered: true, overrun: skip}}}\n",
                "robot.yaml:1:56: error: component 'A': overrun does not apply to a triggered "
                "activity, "
                "which has no period\n"},
        Mistake{"unknown_setting",
                "components: {A: {model: M, activity: {periodic: 1 ms, prio: 9}}}\n",
                "robot.yaml:1:55: error: component 'A': unknown key 'prio'\n"}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    OfAConnection, Mistakes,
    testing::Values(
        Mistake{"no_arrow", "connections: [A.Out B.In]\n",
                "robot.yaml:1:15: error: connection: 'A.Out B.In' must have the form "
                "component.port -> component.port (for example Joint1.Position -> "
                "Sensor.Position1)\n"},
        Mistake{"two_arrows", "connections: [A.Out -> B.In -> C.In]\n",
                "robot.yaml:1:15: error: connection: 'A.Out -> B.In -> C.In' must have the form "
                "component.port -> component.port (for example Joint1.Position -> "
                "Sensor.Position1)\n"},
        Mistake{"no_port", "connections: [A.Out -> B]\n",
                "robot.yaml:1:24: error: connection: to must be component.port, found 'B'\n"},
        Mistake{"no_source", "connections: [{to: B.In}]\n",
                "robot.yaml:1:15: error: connection: it has no 'from' (for example Joint1.Position "
                "-> Sensor.Position1)\n"},
        Mistake{"list", "connections: [[A.Out, B.In]]\n",
                "robot.yaml:1:15: error: connection: expected text or a map, found a list (for "
                "example Joint1.Position -> Sensor.Position1)\n"},
        Mistake{"unknown_key", "connections: [{from: A.Out, to: B.In, polcy: latest}]\n",
                "robot.yaml:1:39: error: connection: unknown key 'polcy' (did you mean "
                "'policy'?)\n"},
        Mistake{"policy", "connections: [{from: A.Out, to: B.In, policy: last}]\n",
                "robot.yaml:1:47: error: connection: policy must be latest, found 'last'\n"},
        Mistake{"fifo_without_size", "connections: [{from: A.Out, to: B.In, policy: fifo}]\n",
                "robot.yaml:1:47: error: connection: policy fifo needs its size (for example "
                "{fifo: 8})\n"},
        Mistake{"fifo_of_size_zero", "connections: [{from: A.Out, to: B.In, policy: {fifo: 0}}]\n",
                "robot.yaml:1:54: error: connection: fifo must be a whole number from 1 to "
                "1000000, found '0'\n"},
        Mistake{"overflow",
                "connections: [{from: A.Out, to: B.In, policy: {fifo: 1, overflow: drop}}]\n",
                "robot.yaml:1:67: error: connection: overflow must be drop_newest or drop_oldest, "
                "found 'drop'\n"},
        Mistake{
            "age_without_unit", "connections: [{from: A.Out, to: B.In, max_age: 30}]\n",
            "robot.yaml:1:48: error: connection: max_age must be a duration with its unit, found "
            "'30' (for example 10 ms)\n"},
        Mistake{"reaction", "connections: [{from: A.Out, to: B.In, max_age: 1 s, on_old: halt}]\n",
                "robot.yaml:1:61: error: connection: on_old must be hold, zero, stop or fault, "
                "found 'halt'\n"},
        Mistake{"reaction_to_nothing", "connections: [{from: A.Out, to: B.In, on_old: stop}]\n",
                "robot.yaml:1:47: error: connection: on_old has no effect without max_age (for "
                "example max_age: 100 ms)\n"},
        Mistake{"delay", "connections: [{from: A.Out, to: B.In, delay: 2}]\n",
                "robot.yaml:1:46: error: connection: delay must be one_cycle, found '2'\n"},
        Mistake{"given_twice", "connections:\n- A.Out -> B.In\n- {from: A.Out, to: B.In}\n",
                "robot.yaml:3:3: error: connection 'A.Out -> B.In' is given twice (first at "
                "robot.yaml:2:3)\n"},
        Mistake{"ports_without_name", "connections: [{ports: [A.Out, B.In]}]\n",
                "robot.yaml:1:15: error: connection: ports that are connected by name need that "
                "'name'\n"},
        Mistake{"single_port", "connections: [{name: n, ports: [A.Out]}]\n",
                "robot.yaml:1:15: error: connection 'n': only one port has this name; nothing is "
                "connected\n"},
        Mistake{"port_twice", "connections: [{name: n, ports: [A.Out, A.Out]}]\n",
                "robot.yaml:1:40: error: connection 'n': port 'A.Out' is given twice (first at "
                "robot.yaml:1:33)\n"}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    OfRangesAndParameters, Mistakes,
    testing::Values(
        Mistake{"empty_range", "components:\n  J{3..1}: {model: M}\n",
                "robot.yaml:2:3: error: 'J{3..1}': the range is empty, its last number is below "
                "its first\n"},
        Mistake{"huge_range", "components:\n  J{1..100001}: {model: M}\n",
                "robot.yaml:2:3: error: 'J{1..100001}': the range has more than 100000 numbers\n"},
        Mistake{"bound_that_is_no_number", "components:\n  J{1..n}: {model: M}\n",
                "robot.yaml:2:3: error: 'J{1..n}': a range has the form {first..last} (bounds are "
                "whole numbers or parameters: {1..${joints}})\n"},
        Mistake{"number_below_zero",
                "components:\n  J{0..1}: {model: M, properties: {x: \"a{i-1}\"}}\n",
                "robot.yaml:2:39: error: {i-1} is -1 for i = 0 (numbers in names begin at 0)\n"},
        Mistake{"ranges_that_differ_at_the_ends", "connections:\n  - J{1..2}.Out -> S.In{1..3}\n",
                "robot.yaml:2:20: error: connection: range {1..3} does not fit {1..2} at its other "
                "end (write the range once and {i} elsewhere)\n"},
        Mistake{"two_ranges_at_one_end", "connections:\n  - J{1..2}.Out{1..2} -> S.In\n",
                "robot.yaml:2:5: error: connection: 'J{1..2}.Out{1..2}' has two ranges (write the "
                "range once and {i} elsewhere)\n"},
        Mistake{"components_of_different_ranges",
                "components:\n  J{1..2}: {model: M}\n  A{1..3}: {model: M}\n"
                "connections:\n  - A{i}.Out -> J{i}.In\n",
                "robot.yaml:5:17: error: connection: J{i} runs over {1..2} but A{i} over {1..3} "
                "(write the range that is meant, for example {1..3}, in place of {i})\n"},
        Mistake{"number_of_no_range",
                "components:\n  Joint{1..2}: {model: M}\nconnections:\n  - Jont{i}.Out -> S.In\n",
                "robot.yaml:4:5: error: connection: {i} in 'Jont{i}.Out' has no range (did you "
                "mean 'Joint{i}'?)\n"},
        Mistake{"number_in_ports_only", "connections:\n  - A.Out{i} -> S.In{i}\n",
                "robot.yaml:2:5: error: connection: {i} in 'A.Out{i}' has no range (write a range, "
                "for example {1..3}, in place of {i})\n"},
        Mistake{"chain_longer_than_the_range",
                "components:\n  J{1..2}: {model: M}\nconnections:\n  - J{i}.Out -> J{i+5}.In\n",
                "robot.yaml:4:5: error: connection: no {i} exists at both ends\n"},
        Mistake{"unknown_parameter",
                "parameters: {joints: 2}\ncomponents: {A: {model: M, peers: [\"x${jonts}\"]}}\n",
                "robot.yaml:2:36: error: the document has no parameter 'jonts' (did you mean "
                "'joints'?)\n"},
        Mistake{"parameter_without_value", "parameters: {bus: }\n",
                "robot.yaml:1:14: error: the document: parameter 'bus' has no value\n"},
        Mistake{"parameter_of_itself", "parameters: {a: \"${b}\", b: \"${a}\"}\n",
                "robot.yaml:1:14: error: parameter 'a' refers to itself (give one parameter of the "
                "circle a value of its own)\n"},
        Mistake{"list_in_a_text",
                "parameters: {v: [1]}\ncomponents: {A: {model: M, properties: {x: \"v${v}\"}}}\n",
                "robot.yaml:2:44: error: parameter 'v' is a list and cannot be part of a text\n"}),
    name_of);

TEST(Mistakes, AreAllFoundInOneRun) {
  EXPECT_EQ(load_yaml("aplication: x\n"
                      "components:\n"
                      "  A: {modl: M}\n"
                      "  B: {model: M, activity: {periodic: 10}}\n"
                      "connections: [A.Out, B.Out -> A]\n")
                .diagnostics.error_count(),
            6u);
}

TEST(Mistakes, LeaveWhatCouldBeRead) {
  const internal::Loaded loaded =
      load_yaml("components:\n  A: {model: M, activity: x}\n  B: {model: N}\n");
  EXPECT_FALSE(loaded.diagnostics.ok());
  ASSERT_EQ(loaded.document.components.size(), 2u);
  EXPECT_EQ(loaded.document.components[0].model, "M");
}

}  // namespace
}  // namespace armature::deploy
