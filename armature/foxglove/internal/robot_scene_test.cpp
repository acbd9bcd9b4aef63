// SPDX-License-Identifier: Apache-2.0
#include "armature/foxglove/internal/robot_scene.hpp"

#include <array>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/foxglove/internal/scene_schemas.hpp"

namespace armature::foxglove::internal {
namespace {

constexpr const char* kArm = R"(<robot name="arm">
  <link name="base"><visual><geometry><box size="1 2 3"/></geometry></visual></link>
  <link name="tip"><visual><geometry><sphere radius="1"/></geometry></visual></link>
  <joint name="turn" type="revolute"><parent link="base"/><child link="tip"/><origin xyz="0 0 1"/><axis xyz="0 0 1"/></joint>
</robot>)";

/// Whether each member of `value` is one of the schema, and of its type.
void expect_fits(const Json& value, const Json& schema) {
  const std::string type = schema.at("type");
  if (type == "object") {
    ASSERT_TRUE(value.is_object()) << value;
    for (const auto& [name, member] : value.items()) {
      ASSERT_TRUE(schema.at("properties").contains(name)) << name;
      expect_fits(member, schema["properties"][name]);
    }
  } else if (type == "array") {
    ASSERT_TRUE(value.is_array()) << value;
    for (const Json& one : value) expect_fits(one, schema.at("items"));
  } else {
    EXPECT_EQ(value.is_string(), type == "string") << value;
  }
}

TEST(RobotSceneTest, FramesTurnWithTheirJointsAndFitTheirSchema) {
  const auto scene = RobotScene::make(kArm, {"Model", "arm.urdf", "", ""}, "Left/").value();
  EXPECT_EQ(scene.joints(), 1u);
  Json transforms = Json::array();
  scene.add_transforms(base::time_from_ns(1'500'000'000), std::array{0.5}, transforms);
  ASSERT_EQ(transforms.size(), 1u);
  EXPECT_EQ(transforms[0]["parent_frame_id"], "Left/base");
  EXPECT_EQ(transforms[0]["child_frame_id"], "Left/tip");
  EXPECT_EQ(transforms[0]["timestamp"], (Json{{"sec", 1}, {"nsec", 500'000'000}}));
  EXPECT_EQ(transforms[0]["translation"]["z"], 1.0);
  EXPECT_NEAR(transforms[0]["rotation"]["z"].get<double>(), std::sin(0.25), 1e-15);
  expect_fits({{"transforms", transforms}}, Json::parse(transforms_schema()));
}

TEST(RobotSceneTest, WhatIsNotKnownStandsAtZero) {
  const auto scene = RobotScene::make(kArm, {"Model", "arm.urdf", "", ""}, "").value();
  for (const std::vector<double>& positions :
       {std::vector<double>{}, {std::numeric_limits<double>::quiet_NaN()}}) {
    Json transforms = Json::array();
    scene.add_transforms(base::Time{}, positions, transforms);
    EXPECT_EQ(transforms[0]["rotation"]["w"], 1.0);
  }
}

TEST(RobotSceneTest, EachLinkIsAnEntityWithItsShapes) {
  const auto scene = RobotScene::make(kArm, {"Model", "arm.urdf", "", ""}, "").value();
  Json entities = Json::array();
  scene.add_entities(base::Time{}, entities);
  ASSERT_EQ(entities.size(), 2u);
  EXPECT_EQ(entities[0]["frame_id"], "base");
  EXPECT_EQ(entities[0]["cubes"][0]["size"]["y"], 2.0);
  EXPECT_EQ(entities[1]["spheres"].size(), 1u);
  expect_fits({{"deletions", Json::array()}, {"entities", entities}}, Json::parse(scene_schema()));
}

TEST(RobotSceneTest, ARobotIsThereOnceHoweverManyComponentsNameIt) {
  std::vector<inspect::ComponentDescription> components(3);
  components[0].name = "Model";
  components[0].properties.resize(2);
  components[0].properties[0].name = "robot_description";
  components[0].properties[0].value = "a/b/../arm.urdf";
  components[0].properties[1].name = "tip_link";
  components[0].properties[1].value = "tip";
  components[1].name = "Check";
  components[1].properties = components[0].properties;
  components[1].properties[0].value = "a/arm.urdf";
  const auto robots = robots_of(components);
  ASSERT_EQ(robots.size(), 1u);
  EXPECT_EQ(robots[0].owner, "Model");
  EXPECT_EQ(robots[0].tip, "tip");
}

}  // namespace
}  // namespace armature::foxglove::internal
