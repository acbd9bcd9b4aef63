// SPDX-License-Identifier: Apache-2.0
#include "armature/studio/internal/journal.hpp"

#include <filesystem>

#include <gtest/gtest.h>

#include "armature/platform/file.hpp"

namespace armature::studio::internal {
namespace {

struct Kept : ::testing::Test {
  ~Kept() override { std::filesystem::remove(path); }
  const std::string path = ::testing::TempDir() + "studio_journal_test.json";
  const Journal journal{path};
};

TEST_F(Kept, GivesBackEveryByte) {
  std::string all;
  for (int byte = 0; byte < 256; ++byte) all += static_cast<char>(byte);
  ASSERT_TRUE(journal.keep({{"arm.yaml", {all, "b\u00e4d"}}, {"new.yaml", {"text", ""}}}));
  const Unsaved left = journal.left();
  ASSERT_EQ(left.size(), 2u);
  EXPECT_EQ(left.at("arm.yaml").text, all);
  EXPECT_EQ(left.at("arm.yaml").disk, "b\u00e4d");
  EXPECT_EQ(left.at("new.yaml").text, "text");
}

TEST_F(Kept, OfNothingNothingIsKept) {
  ASSERT_TRUE(journal.keep({{"arm.yaml", {"new", "old"}}}));
  ASSERT_TRUE(journal.keep({}));
  EXPECT_FALSE(std::filesystem::exists(path));
  EXPECT_TRUE(journal.left().empty());
}

TEST_F(Kept, WhatIsNoJournalLeavesNothing) {
  for (const char* text : {"", "{", "[]", R"({"a": 1})", R"({"a": {"text": "x"}})",
                           R"({"a": {"text": 1, "disk": ""}})"}) {
    ASSERT_TRUE(platform::write_file(path, text));
    EXPECT_TRUE(journal.left().empty()) << text;
  }
}

}  // namespace
}  // namespace armature::studio::internal
