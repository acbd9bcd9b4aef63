// SPDX-License-Identifier: Apache-2.0
#include "armature/rt/guard.hpp"

#include <thread>

#include <gtest/gtest.h>

namespace armature::rt {
namespace {

TEST(GuardState, CountsNestedScopesAndForgetsThemAtTheirEnds) {
  EXPECT_EQ(guard_state().realtime_depth, 0);
  {
    const RealtimeScope outer;
    {
      const RealtimeScope inner;
      EXPECT_EQ(guard_state().realtime_depth, 2);
      const PermitScope permit;
      EXPECT_EQ(guard_state().permitted_depth, 1);
    }
    EXPECT_EQ(guard_state().realtime_depth, 1);
    EXPECT_EQ(guard_state().permitted_depth, 0);
  }
  EXPECT_EQ(guard_state().realtime_depth, 0);
}

TEST(GuardState, BelongsToItsThread) {
  const RealtimeScope here;
  const PermitScope permit;  // for the thread that is made
  int depth_there = -1;
  std::thread([&] { depth_there = guard_state().realtime_depth; }).join();
  EXPECT_EQ(depth_there, 0);
  EXPECT_EQ(guard_state().realtime_depth, 1);
}

TEST(GuardState, AScopeEndsWithAnException) {
  try {
    const RealtimeScope scope;
    const PermitScope permit;
    throw 1;
  } catch (int) {
  }
  EXPECT_EQ(guard_state().realtime_depth, 0);
  EXPECT_EQ(guard_state().permitted_depth, 0);
}

}  // namespace
}  // namespace armature::rt
