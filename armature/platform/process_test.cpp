// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/process.hpp"

#include <cstdio>
#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::platform {
namespace {

TEST(Process, KnowsItsKernel) {
  EXPECT_THAT(kernel_version(), ::testing::MatchesRegex("[0-9]+\\.[0-9]+.* .*"));
}

TEST(ProcessDeathTest, ExitNowSkipsEverythingThatUsuallyComesLast) {
  EXPECT_EXIT(
      {
        std::atexit([] { std::fprintf(stderr, "still here\n"); });
        exit_now(3);
      },
      ::testing::ExitedWithCode(3), "^$");
}

}  // namespace
}  // namespace armature::platform
