// SPDX-License-Identifier: Apache-2.0
#include "armature/foxglove/internal/joint_source.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::foxglove::internal {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

void add_output(std::vector<inspect::ComponentDescription>& to, const std::string& component,
                const std::string& port, const std::string& type, const std::string& doc) {
  inspect::ComponentDescription& one = to.emplace_back();
  one.name = component;
  inspect::OutputDescription& output = one.outputs.emplace_back();
  output.name = port;
  output.type = type;
  output.unit = "rad";
  output.doc = doc;
  if (type.starts_with("vector")) output.size = 2;
}

TEST(JointSourceTest, AListOfMeasuredPositionsIsFoundAndAReferenceIsNot) {
  std::vector<inspect::ComponentDescription> components;
  add_output(components, "Generator", "Reference", "vector<double>", "desired positions");
  add_output(components, "Sensor", "Positions", "vector<double>", "measured positions");
  const auto source = joint_source(components, "Model", 2, "");
  ASSERT_TRUE(source.ok()) << source.error();
  EXPECT_THAT(source.value().items, ElementsAre("Sensor.Positions"));
}

TEST(JointSourceTest, PortsThatAreCountedAreFoundInTheirOrder) {
  std::vector<inspect::ComponentDescription> components;
  for (const char* const name : {"Joint10", "Joint2", "Joint1"}) {
    add_output(components, name, "Position", "double", "measured");
  }
  const auto source = joint_source(components, "Model", 3, "");
  ASSERT_TRUE(source.ok()) << source.error();
  EXPECT_EQ(source.value().port, "Joint{1..10}.Position");
  EXPECT_THAT(source.value().items,
              ElementsAre("Joint1.Position", "Joint2.Position", "Joint10.Position"));
}

TEST(JointSourceTest, WhatIsNotClearIsSaidAndMayBeChosen) {
  std::vector<inspect::ComponentDescription> components;
  EXPECT_THAT(joint_source(components, "Model", 2, "").error(), HasSubstr("no port looks like"));
  add_output(components, "Left", "Positions", "vector<double>", "measured");
  add_output(components, "Right", "Positions", "vector<double>", "measured");
  EXPECT_THAT(joint_source(components, "Model", 2, "").error(), HasSubstr("look alike"));
  EXPECT_EQ(joint_source(components, "Model", 2, "Right.Positions").value().port,
            "Right.Positions");
  EXPECT_THAT(joint_source(components, "Model", 2, "Up.Positions").error(),
              HasSubstr("'Up.Positions', which was chosen"));
}

TEST(JointSourceTest, OfTwoRobotsEachHasItsOwnComposites) {
  std::vector<inspect::ComponentDescription> components;
  add_output(components, "Left.Sensor", "Positions", "vector<double>", "measured");
  add_output(components, "Right.Sensor", "Positions", "vector<double>", "measured");
  EXPECT_EQ(joint_source(components, "Right.Model", 2, "").value().port, "Right.Sensor.Positions");
}

}  // namespace
}  // namespace armature::foxglove::internal
