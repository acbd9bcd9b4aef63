// SPDX-License-Identifier: Apache-2.0
#include "armature/foxglove/internal/flow_json.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/testing/test_types.hpp"

namespace armature::foxglove::internal {
namespace {

using ::testing::HasSubstr;

Json read_as(const std::string& type, const std::string& text) {
  return json_of_text(shape_of(type, {}), text);
}

TEST(FlowJson, NumbersBooleansListsAndTextsAreThemselves) {
  EXPECT_EQ(read_as("double", "0.5"), 0.5);
  EXPECT_EQ(read_as("int", "-3"), -3);
  EXPECT_EQ(read_as("uint64", "18446744073709551615"), 18446744073709551615u);
  EXPECT_EQ(read_as("bool", "true"), true);
  EXPECT_EQ(read_as("vector<double>", "[1, 2.5, nan]").dump(), "[1,2.5,null]");
  EXPECT_EQ(read_as("vector<double>", "[]").dump(), "[]");
  EXPECT_EQ(read_as("text", "[1, 2"), "[1, 2");
  EXPECT_EQ(read_as("Mode", "catch_up"), "catch_up");
}

TEST(FlowJson, WhatCannotBeReadIsATextAsItIs) {
  EXPECT_EQ(read_as("vector<double>", "[1, 2"), "[1, 2");
  EXPECT_EQ(read_as("vector<double>", std::string(1000, '[')), std::string(1000, '['));
}

TEST(FlowJson, ReadsEveryStructThatIsWritten) {
  const types::Everything everything = types::make_everything();
  const types::Type& type = types::type_of<types::Everything>();
  const Shape structure{Shape::Kind::kStruct, type.name};
  const Json json = json_of_text(structure, types::to_text(type, &everything));
  ASSERT_TRUE(json.is_object());
  EXPECT_EQ(json.size(), type.fields.size());
}

TEST(FlowJson, WhatIsSetIsWrittenAsFilesHaveIt) {
  EXPECT_EQ(text_of_json(0.1).value(), "0.1");
  EXPECT_EQ(text_of_json("open").value(), "open");
  EXPECT_EQ(text_of_json(Json::parse(R"({"gains":[1,2.5],"name":"a\"b","on":true})")).value(),
            R"({gains: [1, 2.5], name: "a\"b", on: true})");
  EXPECT_THAT(text_of_json(nullptr).error(), HasSubstr("found null"));
  Json deep = 1;
  for (int i = 0; i < 50; ++i) deep = Json::array({deep});
  EXPECT_THAT(text_of_json(deep).error(), HasSubstr("too deeply"));
}

}  // namespace
}  // namespace armature::foxglove::internal
