// SPDX-License-Identifier: Apache-2.0
#include "armature/base/diagnostic.hpp"

#include <gtest/gtest.h>

namespace armature::base {
namespace {

TEST(Diagnostic, NamesPlaceSeverityMessageAndHint) {
  EXPECT_EQ(
      to_text(
          {Severity::kError, {"arm.yaml", 12, 3}, "no port 'positon'", "did you mean 'position'?"}),
      "arm.yaml:12:3: error: no port 'positon' (did you mean 'position'?)");
}

TEST(Diagnostic, LeavesOutWhatIsUnknown) {
  EXPECT_EQ(to_text({Severity::kWarning, {"arm.yaml", 12, 0}, "m", ""}), "arm.yaml:12: warning: m");
  EXPECT_EQ(to_text({Severity::kNote, {"arm.yaml", 0, 3}, "m", ""}), "arm.yaml: note: m");
  EXPECT_EQ(to_text({Severity::kError, {}, "m", ""}), "error: m");
}

TEST(Diagnostics, AreOkWithoutErrors) {
  Diagnostics diagnostics;
  EXPECT_TRUE(diagnostics.ok());
  EXPECT_TRUE(diagnostics.empty());
  diagnostics.warning({}, "slow");
  diagnostics.note({}, "by the way");
  EXPECT_TRUE(diagnostics.ok());
  EXPECT_FALSE(diagnostics.empty());
}

TEST(Diagnostics, CountErrorsHoweverTheyAreAdded) {
  Diagnostics others;
  others.error({}, "first");
  others.warning({}, "not counted");
  Diagnostics diagnostics;
  diagnostics.error({}, "second");
  diagnostics.add({Severity::kError, {}, "third", {}});
  diagnostics.append(others);
  EXPECT_FALSE(diagnostics.ok());
  EXPECT_EQ(diagnostics.error_count(), 3u);
  ASSERT_EQ(diagnostics.all().size(), 4u);
  EXPECT_EQ(diagnostics.all()[2].message, "first");
}

TEST(Diagnostics, ListTheirTextByPlaceAndOtherwiseInOrder) {
  Diagnostics diagnostics;
  diagnostics.error({"b.yaml", 1, 1}, "1");
  diagnostics.error({"a.yaml", 9, 1}, "2");
  diagnostics.error({"a.yaml", 2, 7}, "3");
  diagnostics.error({"a.yaml", 2, 3}, "4");
  diagnostics.note({"a.yaml", 2, 7}, "5");
  EXPECT_EQ(diagnostics.to_text(),
            "a.yaml:2:3: error: 4\n"
            "a.yaml:2:7: error: 3\n"
            "a.yaml:2:7: note: 5\n"
            "a.yaml:9:1: error: 2\n"
            "b.yaml:1:1: error: 1\n");
}

TEST(Diagnostics, AtOnePlaceWhatDiffersInNumbersOnlyIsToldOnceWithFirstLastAndCount) {
  Diagnostics diagnostics;
  for (int i = 1; i <= 50; ++i) {
    diagnostics.error({"a.yaml", 2, 3}, "'G" + std::to_string(i) + ".Out' has no unit", "add it");
  }
  EXPECT_EQ(diagnostics.error_count(), 50u);
  EXPECT_EQ(diagnostics.to_text(),
            "a.yaml:2:3: error: 'G1.Out' has no unit, likewise 49 others, 'G2.Out' to 'G50.Out' "
            "(add it)\n");
}

TEST(Diagnostics, OneOtherIsNamedAndTheSameTwiceIsToldOnce) {
  Diagnostics diagnostics;
  diagnostics.error({"a.yaml", 2, 3}, "'A' knows no 'G1'");
  diagnostics.error({"a.yaml", 2, 3}, "'A' knows no 'G1'");
  diagnostics.error({"a.yaml", 2, 3}, "'A' knows no 'G2'");
  diagnostics.error({"a.yaml", 2, 4}, "'A' knows no 'G3'");
  diagnostics.warning({"a.yaml", 2, 3}, "'A' knows no 'G4'");
  EXPECT_EQ(diagnostics.to_text(),
            "a.yaml:2:3: error: 'A' knows no 'G1', likewise 'G2'\n"
            "a.yaml:2:3: warning: 'A' knows no 'G4'\n"
            "a.yaml:2:4: error: 'A' knows no 'G3'\n");
}

TEST(Diagnostics, WithoutALineEachIsToldByItself) {
  Diagnostics diagnostics;
  diagnostics.error({}, "joint 'j1' has no limits");
  diagnostics.error({}, "joint 'j2' has no limits");
  EXPECT_EQ(diagnostics.all().size(), 2u);
}

TEST(Diagnostics, OfOneKindAHundredAreKeptAndTheOthersCounted) {
  Diagnostics diagnostics;
  for (int line = 1; line <= 20'000; ++line) {
    diagnostics.error({"a.yaml", line, 1}, "'x" + std::to_string(line) + "' is given twice");
  }
  diagnostics.error({"a.yaml", 7, 1}, "another mistake");
  EXPECT_EQ(diagnostics.error_count(), 20'001u);
  ASSERT_EQ(diagnostics.all().size(), Diagnostics::kMostOfAKind + 1);
  EXPECT_EQ(to_text(diagnostics.all()[Diagnostics::kMostOfAKind - 1]),
            "a.yaml:100:1: error: 'x100' is given twice; 19900 more are not shown");
  EXPECT_EQ(diagnostics.all().back().message, "another mistake");
}

TEST(Diagnostics, OfAllKindsAThousandAreKept) {
  Diagnostics diagnostics;
  for (int i = 0; i < 5000; ++i) {
    diagnostics.error({"a.yaml", 1, 1}, std::string(static_cast<std::size_t>(i) + 1, 'x'));
  }
  EXPECT_EQ(diagnostics.error_count(), 5000u);
  EXPECT_EQ(diagnostics.all().size(), Diagnostics::kMost);
  EXPECT_EQ(diagnostics.all().back().unshown, 5000 - Diagnostics::kMost);
}

TEST(Diagnostics, AppendedOnesJoinThoseThatAreThere) {
  Diagnostics others;
  others.error({"a.yaml", 2, 3}, "no 'G3'");
  others.error({"a.yaml", 2, 3}, "no 'G4'");
  Diagnostics diagnostics;
  diagnostics.error({"a.yaml", 2, 3}, "no 'G1'");
  diagnostics.append(others);
  EXPECT_EQ(diagnostics.error_count(), 3u);
  EXPECT_EQ(diagnostics.to_text(), "a.yaml:2:3: error: no 'G1', likewise 2 others, 'G3' to 'G4'\n");
}

TEST(Diagnostics, LikewiseAddsOnlyToWhatIsThere) {
  Diagnostics diagnostics;
  diagnostics.error({"a.yaml", 2, 3}, "no 'G1'");
  diagnostics.add_likewise({Severity::kError, {"a.yaml", 2, 3}, "no 'G2'", {}});
  diagnostics.add_likewise({Severity::kError, {"a.yaml", 2, 3}, "another 'G2'", {}});
  EXPECT_EQ(diagnostics.error_count(), 2u);
  EXPECT_EQ(diagnostics.to_text(), "a.yaml:2:3: error: no 'G1', likewise 'G2'\n");
}

}  // namespace
}  // namespace armature::base
