// SPDX-License-Identifier: Apache-2.0
#include "armature/studio/internal/operators_acts.hpp"

#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::studio::internal {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

remote::ComponentDetails component(const std::string& name,
                                   const std::vector<std::pair<std::string, bool>>& operations,
                                   const std::vector<std::pair<std::string, bool>>& properties) {
  remote::ComponentDetails details;
  details.status.name = name;
  for (const auto& [operation, by_operator] : operations) {
    details.operations.emplace_back().name = operation;
    details.operations.back().by_operator = by_operator;
  }
  for (const auto& [property, by_operator] : properties) {
    details.properties.emplace_back().name = property;
    details.properties.back().by_operator = by_operator;
  }
  return details;
}

/// Of an arm whose components are named one within the other.
class Described : public ::testing::Test {
 protected:
  Described() {
    acts_.add(component("Arm", {{"arm", true}, {"disarm", false}, {"stop", false}},
                        {{"at_home", true}, {"gain", false}}));
    acts_.add(component("Arm.at_home", {{"arm", false}, {"disarm", false}}, {{"at_home", false}}));
    acts_.add(component("Brake", {{"release", true}, {"disarm", false}}, {}));
  }
  OperatorsActs acts_;
};

TEST_F(Described, WhatIsTheOperatorsIsToldByTheDescription) {
  EXPECT_EQ(acts_.of_operation("Arm", "arm"), Act::kOperators);
  EXPECT_EQ(acts_.of_operation("Arm", "disarm"), Act::kAnybodys);
  EXPECT_EQ(acts_.of_operation("Arm.at_home", "arm"), Act::kAnybodys);
  EXPECT_EQ(acts_.of_item("Arm.gain"), Act::kAnybodys);
  EXPECT_EQ(acts_.of_item("Arm.gain[2].x"), Act::kAnybodys);
}

TEST_F(Described, WhatIsNotKnownIsUnknown) {
  for (const auto& [name, operation] :
       {std::pair{"Arm", "Arm"}, {"Arm ", "arm"}, {"", ""}, {"Leg", "arm"}}) {
    EXPECT_EQ(acts_.of_operation(name, operation), Act::kUnknown) << name;
  }
  for (const char* item :
       {"", "Arm", "Arm.", "Arm.at_hom", "Arm:at_home", ".Arm.at_home", "Leg.gain"}) {
    EXPECT_EQ(acts_.of_item(item), Act::kUnknown) << item;
  }
}

TEST_F(Described, TheLongestNameIsTheComponents) {
  EXPECT_EQ(acts_.of_item("Arm.at_home"), Act::kUnknown) << "it is a component";
  EXPECT_EQ(acts_.of_item("Arm.at_home.at_home"), Act::kAnybodys);
}

TEST_F(Described, DisarmedIsWhatAnOperatorArms) {
  EXPECT_THAT(acts_.disarmed(), ElementsAre("Arm"));
}

TEST_F(Described, ItIsCompleteOnceAllThatAreThereWereDescribed) {
  EXPECT_FALSE(acts_.complete()) << "nobody said what there is";
  remote::ComponentStatus arm;
  arm.name = "Arm";
  remote::ComponentStatus leg;
  leg.name = "Leg";
  acts_.expect({arm, leg});
  EXPECT_THAT(acts_.missing(), ElementsAre("Leg"));
  EXPECT_FALSE(acts_.complete());
  acts_.add(component("Leg", {}, {}));
  EXPECT_THAT(acts_.missing(), IsEmpty());
  EXPECT_TRUE(acts_.complete());
}

}  // namespace
}  // namespace armature::studio::internal
