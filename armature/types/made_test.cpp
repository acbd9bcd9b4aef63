// SPDX-License-Identifier: Apache-2.0
#include "armature/types/made.hpp"

#include <cstdint>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/types/enum.hpp"
#include "armature/types/struct.hpp"

namespace armature::types {
namespace {

using testing::HasSubstr;

enum class Gear : std::uint8_t { kNeutral, kFirst = 3 };
ARMATURE_ENUM(Gear, kNeutral, kFirst);
struct Wheel {
  bool driven;
  double speed;
  Gear gear;
  std::array<std::int16_t, 3> ticks;
  base::FixedText<15> name;
};
ARMATURE_STRUCT(Wheel, driven, (speed, "m/s", "of the rim"), gear, ticks, name);

const Type& made_gear() {
  return made_enum("Gear", type_of<std::uint8_t>(), {{"neutral", 0}, {"first", 3}});
}

base::Result<const Type*> made_wheel() {
  return made_struct("Wheel", {{"driven", &type_of<bool>()},
                               {"speed", &type_of<double>(), "m/s", "of the rim"},
                               {"gear", &made_gear()},
                               {"ticks", made_array(type_of<std::int16_t>(), 3).value()},
                               {"name", &type_of<base::FixedText<15>>()}});
}

TEST(MadeType, IsTheOneThatCppDescribesByTheSameNameAndFields) {
  const Type& made = *made_wheel().value();
  EXPECT_NE(&made, &type_of<Wheel>());
  EXPECT_TRUE(same_type(made, type_of<Wheel>()));
  EXPECT_EQ(made.hash, type_of<Wheel>().hash);
  EXPECT_EQ(made.size, sizeof(Wheel));
  EXPECT_EQ(made.alignment, alignof(Wheel));
  EXPECT_EQ(made.fields[1].unit, "m/s");
  EXPECT_EQ(made.fields[1].doc, "of the rim");
  EXPECT_TRUE(same_type(made_gear(), type_of<Gear>()));
}

TEST(MadeType, HoldsValuesThatCppReads) {
  Value value(*made_wheel().value());
  EXPECT_EQ(value.text(),
            R"({driven: false, speed: 0, gear: neutral, ticks: [0, 0, 0], name: ""})");
  ASSERT_TRUE(from_text(
      value.type(), R"({driven: true, speed: 0.5, gear: first, ticks: [1, -2, 3], name: "left"})",
      value.data()));
  const Value copy = value;
  const auto* wheel = copy.get_if<Wheel>();
  ASSERT_NE(wheel, nullptr);
  EXPECT_TRUE(wheel->driven);
  EXPECT_EQ(wheel->speed, 0.5);
  EXPECT_EQ(wheel->gear, Gear::kFirst);
  EXPECT_EQ(wheel->ticks[1], -2);
  EXPECT_EQ(wheel->name.view(), "left");
}

TEST(MadeType, IsTheSameForTheSameDescription) {
  EXPECT_EQ(made_wheel().value(), made_wheel().value());
  EXPECT_EQ(made_array(type_of<float>(), 7).value(), made_array(type_of<float>(), 7).value());
  const auto point = [](const std::string& unit) {
    return made_struct("Point", {{"x", &type_of<int>(), unit}}).value();
  };
  EXPECT_EQ(point("m"), point("m"));
  EXPECT_NE(point("m"), point("px"));
  EXPECT_TRUE(same_type(*point("m"), *point("px")));
}

TEST(MadeType, ListsTakeAnyNumberOfScalarsAndTexts) {
  EXPECT_TRUE(same_type(*made_vector(type_of<double>()).value(), type_of<std::vector<double>>()));
  EXPECT_TRUE(
      same_type(*made_vector(type_of<std::string>()).value(), type_of<std::vector<std::string>>()));
  Value flags(*made_vector(type_of<bool>()).value());
  ASSERT_TRUE(from_text(flags.type(), "[true, false]", flags.data()));
  EXPECT_EQ(flags.text(), "[true, false]");
  Value gears(*made_vector(made_gear()).value());
  ASSERT_TRUE(from_text(gears.type(), "[first, neutral, first]", gears.data()));
  EXPECT_EQ(gears.text(), "[first, neutral, first]");
}

TEST(MadeType, WhatGrowsOrIsTooLargeIsRefused) {
  EXPECT_THAT(made_struct("Note", {{"text", &type_of<std::string>()}}).error(),
              HasSubstr("field text: text grows"));
  EXPECT_THAT(made_array(type_of<std::string>(), 2).error(), HasSubstr("text grows"));
  EXPECT_TRUE(made_array(type_of<double>(), kLargestMade / 8));
  EXPECT_THAT(made_array(type_of<double>(), kLargestMade / 8 + 1).error(),
              HasSubstr("has 4104 bytes, more than the 4096"));
  const Type* const half = made_array(type_of<double>(), kLargestMade / 16 + 1).value();
  EXPECT_THAT(made_struct("Scan", {{"a", half}, {"b", half}}).error(),
              HasSubstr("struct Scan has 4112 bytes"));
  EXPECT_THAT(made_vector(*made_wheel().value()).error(),
              HasSubstr("vector<Wheel> has elements that are neither numbers, bools"));
}

/// The last one: it takes all the room that there is.
TEST(MadeTypeAtLast, OneSizeMoreThanThereIsRoomForIsRefused) {
  std::string problem;
  std::size_t made = 0;
  for (std::size_t count = 1; count <= kLargestMade && problem.empty(); ++count) {
    const auto array = made_array(type_of<std::uint8_t>(), count);
    if (!array) problem = array.error();
    if (array) ++made;
  }
  EXPECT_GT(made, 100u);
  EXPECT_THAT(problem, HasSubstr("has another size than 128 structs and arrays before it"));
  EXPECT_TRUE(made_array(type_of<std::int8_t>(), 1)) << "of a size that there is";
}

}  // namespace
}  // namespace armature::types
