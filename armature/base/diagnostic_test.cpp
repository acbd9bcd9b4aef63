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

}  // namespace
}  // namespace armature::base
