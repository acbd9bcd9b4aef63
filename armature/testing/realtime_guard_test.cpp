// SPDX-License-Identifier: Apache-2.0
#include "armature/testing/realtime_guard.hpp"

#include <cstdlib>
#include <string_view>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::testing {
namespace {

using ::testing::HasSubstr;

void allocate() {
  void* volatile memory = std::malloc(40);
  std::free(memory);
}

class RealtimeGuardTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (std::string_view(ARMATURE_SANITIZER) == "realtime") {
      GTEST_SKIP() << "RealtimeSanitizer ends the process at the first violation";
    }
  }
};

TEST_F(RealtimeGuardTest, SeesAllocationOnlyInRealtimeCode) {
  RealtimeGuard guard;
  allocate();
  EXPECT_EQ(guard.violations(), 0u) << guard.report();
  EXPECT_EQ(guard.watch(allocate), 2u) << guard.report();
}

TEST_F(RealtimeGuardTest, SeesNothingOfWhatIsPermitted) {
  RealtimeGuard guard;
  EXPECT_EQ(guard.watch([] {
    const rt::PermitScope permit;
    allocate();
  }),
            0u)
      << guard.report();
}

TEST_F(RealtimeGuardTest, BeginsWithoutTheViolationsOfOthers) {
  {
    RealtimeGuard before;
    EXPECT_NE(before.watch(allocate), 0u);
  }
  const RealtimeGuard guard;
  EXPECT_EQ(guard.violations(), 0u);
}

TEST_F(RealtimeGuardTest, ReportsEachPlaceOnceWithItsCount) {
  RealtimeGuard guard;
  for (int i = 0; i < 3; ++i) guard.watch(allocate);
  EXPECT_THAT(guard.report(), HasSubstr("called malloc(40 bytes), 3 times"));
  EXPECT_THAT(guard.report(), HasSubstr("6 violations at 2 places"));
}

}  // namespace
}  // namespace armature::testing
