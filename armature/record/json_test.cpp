// SPDX-License-Identifier: Apache-2.0
#include "armature/record/json.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/record/internal/test_types.hpp"

namespace armature::record {
namespace {

using testing::HasSubstr;
using types::type_of;

template <typename T>
std::string json_of(const T& value) {
  return to_json(type_of<T>(), &value);
}

template <typename T>
T read(std::string_view json) {
  T value{};
  const auto done = from_json(type_of<T>(), json, &value);
  EXPECT_TRUE(done) << done.error();
  return value;
}

template <typename T>
std::string problem(std::string_view json) {
  T value{};
  const auto done = from_json(type_of<T>(), json, &value);
  return done ? "none" : done.error();
}

TEST(Json, AStructIsAnObjectAndAnythingElseAMemberOfOne) {
  EXPECT_EQ(json_of(Pose{0.5, -2}), R"({"x":0.5,"y":-2})");
  EXPECT_EQ(json_of(0.1), R"({"value":0.1})");
  EXPECT_EQ(json_of(true), R"({"value":true})");
  EXPECT_EQ(json_of(std::vector<int>{1, -2}), R"({"value":[1,-2]})");
  EXPECT_EQ(json_of(std::array<Pose, 1>{}), R"({"value":[{"x":0,"y":0}]})");
  EXPECT_EQ(json_of(std::string("say \"\\\n\x01µ")), R"({"value":"say \"\\\u000a\u0001µ"})");
}

TEST(Json, EveryKindOfTypeComesBackAsItWas) {
  const Everything value = make_everything();
  EXPECT_EQ(read<Everything>(json_of(value)), value);
  EXPECT_EQ(read<Everything>(json_of(Everything{})), Everything{});
}

TEST(Json, NumbersThatJsonDoesNotHaveComeBack) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(json_of(kInfinity), R"({"value":1e999})");
  EXPECT_EQ(json_of(std::nan("")), R"({"value":null})");
  EXPECT_EQ(read<double>(json_of(kInfinity)), kInfinity);
  EXPECT_EQ(read<double>(json_of(-kInfinity)), -kInfinity);
  EXPECT_TRUE(std::isnan(read<float>(json_of(std::nanf("")))));
  EXPECT_TRUE(std::signbit(read<double>(json_of(-0.0))));
}

TEST(Json, DoublesComeBackToTheBit) {
  std::uint64_t bits = 1;
  for (int i = 0; i < 10000; ++i) {
    bits = bits * 6364136223846793005u + 1442695040888963407u;
    const auto value = std::bit_cast<double>(bits);
    if (std::isnan(value)) continue;
    ASSERT_EQ(std::bit_cast<std::uint64_t>(read<double>(json_of(value))), bits);
  }
}

TEST(Json, BytesThatAreNoUtf8BecomeQuestionMarks) {
  EXPECT_EQ(json_of(std::string("a\xff\xc0\x80z\xe2\x82")), R"({"value":"a???z??"})");
}

TEST(Json, AnErrorSaysWhereWhatWasExpected) {
  EXPECT_EQ(problem<double>(R"({"value":x})"),
            "cannot read double from JSON: expected a number of double at byte 9");
  EXPECT_THAT(problem<Pose>(R"({"x":1,"z":2})"), HasSubstr(R"(expected '"y":' at byte 7)"));
  EXPECT_THAT(problem<bool>(R"({"value":1})"), HasSubstr("true or false"));
  EXPECT_THAT(problem<std::uint8_t>(R"({"value":256})"), HasSubstr("a number of uint8"));
  EXPECT_THAT(problem<base::FixedText<2>>(R"({"value":"abc"})"), HasSubstr("at most 2 bytes"));
  EXPECT_THAT((problem<std::array<int, 2>>(R"({"value":[1]})")), HasSubstr("','"));
  EXPECT_THAT(problem<int>(R"({"value":1}1)"), HasSubstr("the end at byte 11"));
  EXPECT_THAT(problem<std::string>(R"({"value":"\x"})"), HasSubstr("an escaped character"));
}

TEST(Json, AnErrorLeavesTheValueAsItWas) {
  Pose value{1, 2};
  EXPECT_FALSE(from_json(type_of<Pose>(), R"({"x":3,"y":})", &value));
  EXPECT_EQ(value, (Pose{1, 2}));
}

TEST(Json, WhatIsCutOffIsRefusedWhereverItWasCut) {
  const std::string whole = json_of(make_everything());
  Everything value;
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_FALSE(from_json(type_of<Everything>(), std::string(whole, 0, size), &value)) << size;
  }
}

TEST(JsonSchema, DescribesFieldsWithTheirUnits) {
  EXPECT_EQ(json_schema(type_of<Pose>()),
            R"({"type":"object","title":"Pose","properties":{)"
            R"("x":{"type":"number","description":"ahead of the dock [m]"},)"
            R"("y":{"type":"number","description":"[m]"}},"required":["x","y"]})");
}

TEST(Json, AnEnumerationHasItsNames) {
  EXPECT_EQ(json_of(Gait::kTurningOnTheSpot), R"({"value":"turning_on_the_spot"})");
  EXPECT_EQ(read<Gait>(R"({"value":"walking"})"), Gait::kWalking);
  EXPECT_THAT(problem<Gait>(R"({"value":300})"),
              HasSubstr("expected standing, walking or turning_on_the_spot at byte 9"));
}

TEST(JsonSchema, NamesTheValuesOfAnEnumeration) {
  EXPECT_THAT(
      json_schema(type_of<Gait>()),
      HasSubstr(R"({"type":"string","enum":["standing","walking","turning_on_the_spot"]})"));
}

TEST(JsonSchema, WrapsWhatIsNoStruct) {
  EXPECT_EQ(json_schema(type_of<std::array<bool, 3>>()),
            R"({"type":"object","title":"array<bool,3>","properties":{"value":)"
            R"({"type":"array","items":{"type":"boolean"},"minItems":3,"maxItems":3}},)"
            R"("required":["value"]})");
  EXPECT_THAT(json_schema(type_of<std::vector<std::string>>()),
              HasSubstr(R"({"value":{"type":"array","items":{"type":"string"}}})"));
  EXPECT_THAT(json_schema(type_of<int>()), HasSubstr(R"({"value":{"type":"integer"}})"));
}

}  // namespace
}  // namespace armature::record
