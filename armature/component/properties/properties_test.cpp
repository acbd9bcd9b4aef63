// SPDX-License-Identifier: Apache-2.0
#include "armature/component/properties/properties.hpp"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/author.hpp"
#include "armature/component/interface.hpp"
#include "armature/testing/test_thread.hpp"

namespace armature::component {
namespace {

using types::Value;

struct Config {
  double kp = 0.0;
  int tries = 3;
  std::string label = "left";
  double of_the_class_alone = 7.0;
};

class Counting final : public PropertyFollower {
 public:
  void follow() override { ++changes; }
  std::string objection() const override { return {}; }
  int changes = 0;
};

class Motor : public Component {
 public:
  using Component::Component;
  Properties<Config> config{
      this,
      {.kp = 0.5},
      member(&Config::kp, "Kp", "gain", "V/rad", range(0.0, 10.0), changeable_while_running),
      member(&Config::tries, "Tries", "how often", "", mandatory),
      member(&Config::label, "Label", "its name")};
};

class StructOfProperties : public ::testing::Test {
 protected:
  StructOfProperties() : thread_(motor_) {}
  PropertyBase& property(std::size_t i) { return *interface_of(motor_).properties.at(i); }
  Motor motor_{"motor"};
  TestThread thread_;
};

TEST_F(StructOfProperties, ReadsAsTheStruct) {
  EXPECT_EQ(motor_.config->kp, 0.5);
  EXPECT_EQ(motor_.config.get().tries, 3);
}

TEST_F(StructOfProperties, HasAPropertyForEachMemberThatIsListed) {
  ASSERT_EQ(interface_of(motor_).properties.size(), 3u);
  EXPECT_EQ(property(0).name(), "Kp");
  EXPECT_EQ(property(0).unit(), "V/rad");
  EXPECT_TRUE(property(0).changeable());
  EXPECT_EQ(property(0).limits()->high, 10.0);
  EXPECT_TRUE(property(1).is_mandatory());
  EXPECT_EQ(property(2).doc(), "its name");
  EXPECT_TRUE(property(2).persistent());
}

TEST_F(StructOfProperties, WhatIsSetIsInTheStruct) {
  EXPECT_TRUE(property(0).set(Value::of(2.0)));
  EXPECT_TRUE(property(2).set(Value::of(std::string("right"))));
  EXPECT_EQ(motor_.config->kp, 2.0);
  EXPECT_EQ(motor_.config->label, "right");
  EXPECT_FALSE(property(0).set(Value::of(11.0)));
  EXPECT_EQ(motor_.config->kp, 2.0);
}

TEST_F(StructOfProperties, FollowersHearOfEachMember) {
  Counting counting;
  motor_.config.add_follower(counting);
  EXPECT_TRUE(property(0).set(Value::of(2.0)));
  EXPECT_TRUE(property(1).set(Value::of(5)));
  EXPECT_EQ(counting.changes, 2);
}

TEST_F(StructOfProperties, CanBeAskedForWithAnotherValue) {
  const int wanted = 9;
  EXPECT_EQ(motor_.config.with(&property(1), &wanted).tries, 9);
  EXPECT_EQ(motor_.config.with(&property(1), &wanted).kp, 0.5);
  EXPECT_EQ(motor_.config.with(nullptr, nullptr).tries, 3);
  EXPECT_EQ(motor_.config->tries, 3);
}

}  // namespace
}  // namespace armature::component
