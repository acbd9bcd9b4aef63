// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "armature/deploy/internal/document_in_memory.hpp"

namespace armature::deploy {

using namespace document;
namespace {

using internal::load_yaml;
using internal::Loaded;

constexpr const char* kRobot =
    "parameters: {joints: 2, bus: vcan0}\n"
    "components:\n"
    "  Joint{1..${joints}}:\n"
    "    model: Joint\n"
    "    activity: {periodic: 10 ms, priority: 80}\n"
    "    properties: {GearRatio: 0.01, bus: \"${bus}\", limits: {low: 1, high: 2}}\n";

Loaded set(const std::vector<std::string>& overrides) { return load_yaml(kRobot, overrides); }

std::string property(const Loaded& loaded, const std::string& name) {
  const Property* found = find(loaded.document.components.at(0).properties, name);
  return found == nullptr ? "(none)" : to_text(found->value);
}

TEST(CommandLine, SetsParametersBeforeRangesAreExpanded) {
  const Loaded loaded = set({"joints=7", "bus=can3"});
  EXPECT_EQ(loaded.messages(), "");
  EXPECT_EQ(loaded.document.components.size(), 7u);
  EXPECT_EQ(property(loaded, "bus"), "can3");
}

TEST(CommandLine, SetsAPropertyOfEachComponentOfARange) {
  const Loaded loaded = set({"joints=3", "Joint{2..3}.GearRatio=0.02"});
  EXPECT_EQ(loaded.messages(), "");
  std::string ratios;
  for (const Component& joint : loaded.document.components) {
    ratios += joint.properties.at(0).value.text + " ";
  }
  EXPECT_EQ(ratios, "0.01 0.02 0.02 ");
}

TEST(CommandLine, RefusesARangeThatLeadsBeyondWhatIsThere) {
  EXPECT_EQ(set({"Joint{2..3}.GearRatio=0.02"}).messages(),
            "<command line>: error: unknown component 'Joint3' in 'Joint3.GearRatio' (did "
            "you mean 'Joint1'?)\n");
}

TEST(CommandLine, RefusesRangesThatCannotBe) {
  EXPECT_EQ(
      set({"Joint{2..1}.GearRatio=0.02"}).messages(),
      "<command line>: error: 'Joint{2..1}.GearRatio': the range is empty, its last number is "
      "below its first\n");
  EXPECT_EQ(set({"Joint{1..2}.Gain{1..2}=0.02"}).messages(),
            "<command line>: error: 'Joint{1..2}.Gain{1..2}' has more than one range (write "
            "numbers in place of all but one)\n");
}

TEST(CommandLine, SetsAPropertyOfOneComponent) {
  const Loaded loaded = set({"Joint1.GearRatio=0.02"});
  EXPECT_EQ(loaded.messages(), "");
  EXPECT_EQ(property(loaded, "GearRatio"), "0.02");
  EXPECT_EQ(loaded.document.components.at(1).properties.at(0).value.text, "0.01");
}

TEST(CommandLine, IsThePlaceOfWhatItSets) {
  const Loaded loaded = set({"Joint1.GearRatio=0.02"});
  EXPECT_EQ(loaded.document.components.at(0).properties.at(0).value.where.file, "<command line>");
}

TEST(CommandLine, AddsAPropertyThatTheDocumentDoesNotHave) {
  EXPECT_EQ(property(set({"Joint1.Brake=true"}), "Brake"), "true");
}

TEST(CommandLine, SetsAFieldOfAPropertyAndListsAndTexts) {
  EXPECT_EQ(property(set({"Joint1.limits.high=9"}), "limits"), "{low: 1, high: 9}");
  EXPECT_EQ(property(set({"Joint1.gains=[1, 2.5]"}), "gains"), "[1, 2.5]");
  EXPECT_EQ(property(set({"Joint1.text=a = b"}), "text"), "\"a = b\"");
  EXPECT_EQ(property(set({"Joint1.text="}), "text"), "\"\"");
}

TEST(CommandLine, SetsTheActivity) {
  const auto activity = [](const std::string& setting) {
    const Loaded loaded = set({setting});
    EXPECT_EQ(loaded.messages(), "");
    return loaded.document.components.at(0).activity;
  };
  EXPECT_EQ(activity("Joint1.activity.periodic=5 ms").period, std::chrono::milliseconds(5));
  EXPECT_EQ(activity("Joint1.activity.periodic=5 ms").priority, 80) << "the rest stays";
  EXPECT_EQ(activity("Joint1.activity.priority=7").priority, 7);
  EXPECT_EQ(activity("Joint1.activity=triggered").kind, Activity::Kind::kTriggered);
  EXPECT_EQ(activity("Joint1.activity={periodic: 1 ms}").period, std::chrono::milliseconds(1));
}

TEST(CommandLine, LastSettingCounts) {
  EXPECT_EQ(set({"joints=3", "joints=4"}).document.components.size(), 4u);
  EXPECT_EQ(property(set({"Joint1.GearRatio=1", "Joint1.GearRatio=2"}), "GearRatio"), "2");
}

TEST(CommandLine, MaySetAParameterThatTheDocumentLeavesOpen) {
  const Loaded loaded =
      load_yaml("parameters: {robot: }\napplication: \"${robot}\"\n", {"robot=x"});
  EXPECT_EQ(loaded.messages(), "");
  EXPECT_EQ(loaded.document.application, "x");
}

TEST(CommandLine, SaysHowAPropertyIsSetAlsoWithoutParametersAndOfAComposite) {
  const char* const rover =
      "composites: {Rover: {parameters: {radius: 0.1}, components: {left: {model: Wheel}}}}\n"
      "components: {R: {model: Rover, properties: {radius: 0.2}}}\n";
  EXPECT_EQ(load_yaml(rover, {"radius=0.3"}).messages(),
            "<command line>: error: the document has no parameter 'radius' (properties are set as "
            "Component.Property=value, here R.radius=0.3)\n");
  EXPECT_EQ(load_yaml(rover, {"Speed=1"}).messages(),
            "<command line>: error: the document has no parameter 'Speed' (properties are set as "
            "Component.Property=value)\n");
}

TEST(CommandLine, ChangesADocumentThatIsLoaded) {
  Loaded loaded = set({});
  apply_override(loaded.document, "Joint1.GearRatio=5", loaded.diagnostics);
  EXPECT_EQ(loaded.messages(), "");
  EXPECT_EQ(property(loaded, "GearRatio"), "5");
}

struct Mistake {
  const char* setting;
  const char* message;
};

class CommandLineMistake : public testing::TestWithParam<Mistake> {};

TEST_P(CommandLineMistake, IsReported) {
  EXPECT_EQ(set({GetParam().setting}).messages(), GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    Each, CommandLineMistake,
    testing::Values(
        Mistake{"joints",
                "<command line>: error: 'joints' must have the form name=value (for "
                "example Joint1.GearRatio=0.02)\n"},
        Mistake{"=3",
                "<command line>: error: '=3' must have the form name=value (for example "
                "Joint1.GearRatio=0.02)\n"},
        Mistake{"jonts=3",
                "<command line>: error: the document has no parameter 'jonts' (did you "
                "mean 'joints'?)\n"},
        Mistake{"GearRatio=0.5",
                "<command line>: error: the document has no parameter 'GearRatio' (properties are "
                "set as Component.Property=value, here Joint1.GearRatio=0.5)\n"},
        Mistake{"Brake=true",
                "<command line>: error: the document has no parameter 'Brake' (known: joints, bus; "
                "properties are set as Component.Property=value)\n"},
        Mistake{"Joint3.x=1",
                "<command line>: error: unknown component 'Joint3' in 'Joint3.x' (did you mean "
                "'Joint1'?)\n"},
        Mistake{"Joint1.x=[1", "<command line>: error: this is not YAML: the [ is not closed\n"},
        Mistake{"Joint1.a b=1",
                "<command line>: error: component 'Joint1': property 'a b' is not a valid name\n"},
        Mistake{
            "Joint1.activity.periodic=5",
            "<command line>: error: component 'Joint1': periodic must be a duration with its unit, "
            "found '5' (for example 10 ms)\n"},
        Mistake{"Joint1.activity.prio=5",
                "<command line>: error: component 'Joint1': unknown key 'prio'\n"},
        Mistake{"joints=0",
                "<command line>: error: 'Joint{1..0}': the range is empty, its last "
                "number is below its first\n"}));

}  // namespace
}  // namespace armature::deploy
