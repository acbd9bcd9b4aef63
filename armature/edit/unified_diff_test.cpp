// SPDX-License-Identifier: Apache-2.0
#include "armature/edit/unified_diff.hpp"

#include <gtest/gtest.h>

namespace armature::edit {
namespace {

std::string diff(const std::string& before, const std::vector<Replacement>& replacements) {
  return unified_diff({"a", before, replaced(before, replacements), replacements,
                       inverse_of(before, replacements)});
}

constexpr const char* kNumbers = "1\n2\n3\n4\n5\n6\n7\n8\n9\n10\n11\n12\n";

TEST(UnifiedDiff, ShowsThreeLinesAroundAChange) {
  EXPECT_EQ(diff(kNumbers, {{10, 11, "six"}}),
            "--- a\n+++ a\n@@ -3,7 +3,7 @@\n 3\n 4\n 5\n-6\n+six\n 7\n 8\n 9\n");
}

TEST(UnifiedDiff, ShowsLinesThatCameOrWent) {
  EXPECT_EQ(diff("1\n2\n", {{2, 2, "new\n"}}), "--- a\n+++ a\n@@ -1,2 +1,3 @@\n 1\n+new\n 2\n");
  EXPECT_EQ(diff("1\n2\n3\n", {{2, 4, ""}}), "--- a\n+++ a\n@@ -1,3 +1,2 @@\n 1\n-2\n 3\n");
  EXPECT_EQ(diff("", {{0, 0, "1\n"}}), "--- a\n+++ a\n@@ -0,0 +1 @@\n+1\n");
}

TEST(UnifiedDiff, JoinsChangesThatAreNear) {
  EXPECT_EQ(diff(kNumbers, {{0, 1, "one"}, {10, 11, "six"}}),
            "--- a\n+++ a\n@@ -1,9 +1,9 @@\n-1\n+one\n 2\n 3\n 4\n 5\n-6\n+six\n 7\n 8\n 9\n");
  EXPECT_EQ(diff(kNumbers, {{0, 1, "one"}, {21, 23, "x"}}),
            "--- a\n+++ a\n@@ -1,4 +1,4 @@\n-1\n+one\n 2\n 3\n 4\n"
            "@@ -8,5 +8,5 @@\n 8\n 9\n 10\n-11\n+x\n 12\n");
}

TEST(UnifiedDiff, TellsOfALastLineWithoutEnd) {
  EXPECT_EQ(diff("1\n2", {{3, 3, "\n3"}}),
            "--- a\n+++ a\n@@ -1,2 +1,3 @@\n 1\n-2\n\\ No newline at end of file\n+2\n+3\n"
            "\\ No newline at end of file\n");
}

}  // namespace
}  // namespace armature::edit
