// SPDX-License-Identifier: Apache-2.0
#include "armature/foxglove/internal/channel_list.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::foxglove::internal {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

inspect::ComponentDescription joint(const std::string& name, const std::string& type) {
  inspect::ComponentDescription description;
  description.name = name;
  inspect::OutputDescription& output = description.outputs.emplace_back();
  output.name = "Position";
  output.type = type;
  output.unit = "rad";
  output.doc = "of the joint";
  return description;
}

TEST(ChannelListTest, ASchemaTellsTypeDocumentationAndUnit) {
  const auto channels = channels_of(joint("Joint1", "double"));
  ASSERT_EQ(channels.size(), 1u);
  EXPECT_EQ(channels[0].advertised.topic, "Joint1.Position");
  EXPECT_EQ(channels[0].advertised.schema_name, "double");
  EXPECT_EQ(Json::parse(channels[0].advertised.schema),
            Json::parse(R"({"type":"object","title":"double","properties":{"value":{"type":"number",
                "description":"of the joint [rad]"}},"required":["value"]})"));
}

TEST(ChannelListTest, StructsAreObjectsAndThoseWithTextsAreAskedFor) {
  auto component = joint("Head", "State");
  component.fields = {{"State", "q", "array<float,2>", "rad", "", {}},
                      {"State", "mode", "Mode", "", "0 off, 1 on", {}}};
  auto channels = channels_of(component);
  const Json schema = Json::parse(channels[0].advertised.schema);
  EXPECT_EQ(schema["properties"]["q"]["items"]["type"], "number");
  EXPECT_EQ(schema["properties"]["q"]["maxItems"], 2);
  EXPECT_EQ(schema["properties"]["mode"]["type"], "integer");
  EXPECT_EQ(channels[0].kind, Channel::Kind::kNumbers);
  component.fields.push_back({"State", "note", "text<16>", "", "", {}});
  EXPECT_EQ(channels_of(component)[0].kind, Channel::Kind::kTexts);
}

TEST(ChannelListTest, ATypeThatContainsItselfEnds) {
  auto component = joint("Odd", "Loop");
  component.fields = {{"Loop", "next", "vector<Loop>", "", "", {}}};
  EXPECT_EQ(channels_of(component).size(), 1u);
}

TEST(ChannelListTest, WhatStaysKeepsItsNumberAndTheRestIsTold) {
  ChannelList list;
  auto both = channels_of(joint("A", "double"));
  both.push_back(channels_of(joint("B", "double"))[0]);
  EXPECT_EQ(list.replace(both).came.size(), 2u);
  auto next = channels_of(joint("B", "double"));
  next.push_back(channels_of(joint("A", "float"))[0]);
  const auto change = list.replace(next);
  EXPECT_THAT(change.gone, ElementsAre(1u));
  ASSERT_EQ(change.came.size(), 1u);
  EXPECT_EQ(change.came[0].id, 3u);
  EXPECT_EQ(list.find(2)->advertised.topic, "B.Position");
  EXPECT_THAT(list.replace(next).came, IsEmpty());
}

}  // namespace
}  // namespace armature::foxglove::internal
