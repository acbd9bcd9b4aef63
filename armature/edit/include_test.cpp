// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "armature/edit/internal/in_memory.hpp"

namespace armature::edit {
namespace {

using internal::edited;
using internal::Files;
using internal::refusal;

constexpr const char* kPart =
    "libraries: [wave]\non_fault: stop_all\ncomponents:\n  A: {model: M}\n  B: {model: M}\n"
    "connections: [A.Out -> B.In]\n";

Files files_with(const std::string& text) {
  return {{"robot.yaml", text},
          {"part.yaml", kPart},
          {"more.yaml", "components: {C: {model: M}}\n"},
          {"again.yaml", "include: part.yaml\n"}};
}

TEST(EditInclude, IsWrittenAtTheHeadBelowTheComments) {
  EXPECT_EQ(edited(files_with("# What it is for.\n\napplication: a\n"), {AddInclude{"part.yaml"}}),
            "# What it is for.\n\ninclude: part.yaml\n\napplication: a\n");
  EXPECT_EQ(edited(files_with("application: a\n"), {AddInclude{"part.yaml"}}),
            "include: part.yaml\napplication: a\n");
}

TEST(EditInclude, BeginsAnEmptyFile) {
  EXPECT_EQ(edited(files_with(""), {AddInclude{"part.yaml"}}), "include: part.yaml\n");
}

TEST(EditInclude, StandsBesideOthers) {
  EXPECT_EQ(edited(files_with("include: part.yaml\n"), {AddInclude{"more.yaml"}}),
            "include: [part.yaml, more.yaml]\n");
  EXPECT_EQ(edited(files_with("include:\n  - part.yaml\n"), {AddInclude{"more.yaml"}}),
            "include:\n  - part.yaml\n  - more.yaml\n");
}

TEST(EditInclude, IsTakenBackWithWhatTheFileSays) {
  EXPECT_EQ(
      edited(files_with("include: part.yaml\napplication: a\n"), {RemoveInclude{"part.yaml"}}),
      "application: a\n");
  EXPECT_EQ(edited(files_with("include: [part.yaml, more.yaml]\n"), {RemoveInclude{"part.yaml"}}),
            "include: [more.yaml]\n");
}

TEST(EditInclude, WhatIsIncludedTwiceStays) {
  EXPECT_EQ(edited(files_with("include: [part.yaml, again.yaml]\n"), {RemoveInclude{"part.yaml"}}),
            "include: [again.yaml]\n");
}

TEST(EditInclude, IsRefusedWithItsReason) {
  const auto why = [](const std::string& text, const Change& change) {
    return refusal(files_with(text), change);
  };
  EXPECT_NE(
      why("application: a\n", AddInclude{"nowhere.yaml"}).find("'nowhere.yaml' does not exist"),
      std::string::npos);
  EXPECT_NE(why("include: part.yaml\n", AddInclude{"part.yaml"}).find("is included already"),
            std::string::npos);
  EXPECT_NE(why("include: part.yaml\n", RemoveInclude{"parts.yaml"})
                .find("no file includes 'parts.yaml' (did you mean 'part.yaml'?)"),
            std::string::npos);
  EXPECT_NE(why("components: {A: {model: M}}\n", AddInclude{"part.yaml"}).find("'A'"),
            std::string::npos);
  EXPECT_NE(why("include: part.yaml\ncomponents: {A: {override: true, properties: {N: 1}}}\n",
                RemoveInclude{"part.yaml"})
                .find("'A'"),
            std::string::npos);
}

TEST(EditInclude, RefusesAFileByWhichAComponentHereBecomesAComposite) {
  Files files = files_with("components: {Rover: {model: Chassis}}\n");
  files["part.yaml"] = "composites: {Chassis: {components: {left: {model: M}}}}\n";
  EXPECT_NE(refusal(files, AddInclude{"part.yaml"}).find("more than that would change"),
            std::string::npos);
}

TEST(EditInclude, TakesAFileWithInstancesOfAComposite) {
  Files files = files_with(
      "composites: {Chassis: {components: {left: {model: M}}}}\n"
      "components: {Rover: {model: Chassis}}\n");
  files["part.yaml"] = "components: {Second: {model: Chassis}}\n";
  EXPECT_NE(edited(files, {AddInclude{"part.yaml"}}).find("include: part.yaml"), std::string::npos);
}

}  // namespace
}  // namespace armature::edit
