// SPDX-License-Identifier: Apache-2.0
#include "armature/browser/internal/plain_values.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::browser::internal {
namespace {

using ::testing::ElementsAre;

std::string in_files(std::string_view typed) {
  const auto value = as_in_files(typed);
  return value ? value.value() : "mistake: " + value.error();
}

std::vector<std::string> arguments(std::string_view line) {
  const auto call = parse_call(line);
  return call ? call.value().arguments : std::vector<std::string>{"mistake: " + call.error()};
}

TEST(TypedValues, BecomeWhatFilesHave) {
  EXPECT_EQ(in_files("0.5"), "0.5");
  EXPECT_EQ(in_files(" 6000 mV "), "6000 mV");
  EXPECT_EQ(in_files("'left'"), "left");
  EXPECT_EQ(in_files("\"a \\\"b\\\"\\n\""), "a \"b\"\n");
  EXPECT_EQ(in_files("{1, 2}"), "[1, 2]");
  EXPECT_EQ(in_files("array( 1,2 )"), "[1, 2]");
  EXPECT_EQ(in_files("[]"), "[]");
  EXPECT_EQ(in_files("{}"), "[]");
  EXPECT_EQ(in_files("{'a', \"b\"}"), "[\"a\", \"b\"]");
  EXPECT_EQ(in_files("{x = 1, y: {2, 3}}"), "{x: 1, y: [2, 3]}");
  EXPECT_EQ(in_files("{{kp = 1}, {kp = 2}}"), "[{kp: 1}, {kp: 2}]");
}

TEST(TypedValues, MistakesSayWhatWasExpected) {
  EXPECT_EQ(in_files("{1, 2"), "mistake: expected '}', found the end of the line");
  EXPECT_EQ(in_files("{1,}"), "mistake: expected a value, found '}'");
  EXPECT_EQ(in_files("{x = 1, 2}"), "mistake: expected ':', found '}'");
  EXPECT_EQ(in_files("'left"), "mistake: a text has no closing '");
  EXPECT_EQ(in_files("[1] 2"), "mistake: expected the end of the line, found '2'");
}

TEST(TypedCalls, HaveTheirArgumentsAsFilesHaveThem) {
  EXPECT_THAT(arguments("Arming:arm()"), ElementsAre());
  EXPECT_THAT(arguments("Generator:moveTo({1.0, -1e-3}, 10)"), ElementsAre("[1.0, -1e-3]", "10"));
  EXPECT_THAT(arguments("Log:note('a, b', true)"), ElementsAre("a, b", "true"));
  const auto call = parse_call("left.hand.Finger:bend(1)");
  EXPECT_EQ(call.value().component + " " + call.value().operation, "left.hand.Finger bend");
  EXPECT_THAT(arguments("A:b(1"),
              ElementsAre("mistake: A.b: expected ')', found the end of the line"));
  EXPECT_THAT(arguments("A:b(1) + 2"),
              ElementsAre("mistake: A.b: expected the end of the line, found '+ 2'"));
}

TEST(TypedCalls, AreToldFromOtherLines) {
  EXPECT_TRUE(is_call("Generator:moveTo(1)"));
  EXPECT_TRUE(is_call("aic-1:sum()"));
  EXPECT_FALSE(is_call("Settings.Label = 'a:b(c)'"));
  EXPECT_FALSE(is_call("Joint1.Position"));
  EXPECT_FALSE(is_call("f(x)"));
}

TEST(ValuesForPeople, HaveDigitsWorthReadingAndNotTooManyElements) {
  EXPECT_EQ(for_people("1.00000036123", "double", {}, 8), "1.00000036");
  EXPECT_EQ(for_people("123456789012", "int64", {}, 8), "123456789012");
  EXPECT_EQ(for_people("[0.1, 0.30000000000000004]", "vector<double>", {}, 8), "[0.1, 0.3]");
  EXPECT_EQ(for_people("[1, 2, 3, 4]", "array<int32,4>", {}, 2), "[1, 2, ... 4 elements]");
  EXPECT_EQ(for_people("[]", "vector<double>", {}, 2), "[]");
  EXPECT_EQ(for_people("nan", "double", {}, 2), "nan");
  EXPECT_EQ(for_people("a\nb", "text<31>", {}, 2), "\"a\\nb\"");
}

TEST(ValuesForPeople, HaveTheUnitsOfTheirMembers) {
  const std::vector<remote::FieldDetails> fields{{"Gains", "kp", "double", "V/rad", ""},
                                                 {"Gains", "of", "Axis", "", ""},
                                                 {"Axis", "name", "text", "", ""},
                                                 {"Axis", "at", "vector<double>", "m", ""}};
  EXPECT_EQ(for_people("{kp: 0.5, of: {name: \"a, {\\\"b\", at: [1, 2]}}", "Gains", fields, 8),
            "{kp: 0.5 V/rad, of: {name: \"a, {\\\"b\", at: [1, 2] m}}");
  EXPECT_EQ(for_people("[{kp: 1, of: {}}]", "vector<Gains>", fields, 8), "[{kp: 1 V/rad, of: {}}]");
}

TEST(ValuesForPeople, BrokenTextEndsSomewhere) {
  for (const char* text :
       {"[1, ", "[", "{", "{kp", "{kp: ", "[[[", "\"a", "]", "[}", "{]", "[1}]"}) {
    EXPECT_LE(for_people(text, "vector<double>", {}, 8).size(), 40u) << text;
  }
}

TEST(ValuesForPeople, DepthCostsNoStack) {
  const std::string deep(1u << 20, '[');
  EXPECT_LE(for_people(deep, "vector<double>", {}, 8).size(), 2 * deep.size());
  EXPECT_EQ(in_files(deep), "mistake: lists and structs are nested too deep");
}

TEST(HarmlessText, MovesNoCursor) {
  EXPECT_EQ(harmless("a\x1b[2J\x07\x7f"
                     "b\n\tc"),
            "a?[2J??b\n\tc");
  EXPECT_EQ(harmless("gr\xc3\xb6\xc3\x9f"
                     "er 5 \xc2\xb5m \xc2\x9b"),
            "gr\xc3\xb6\xc3\x9f"
            "er 5 \xc2\xb5m \xc2?");
}

}  // namespace
}  // namespace armature::browser::internal
