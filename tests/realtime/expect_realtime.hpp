// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include <gtest/gtest.h>

#include "armature/testing/realtime_guard.hpp"

namespace armature {

/// Expects that `code`, which calls `function`, does nothing that a real-time thread must not do,
/// neither the first time nor later. check_coverage.py looks for the name.
template <typename Code>
void expect_realtime(const char* function, Code&& code) {
  testing::RealtimeGuard guard;
  EXPECT_EQ(guard.watch(code), 0u) << function << ", first call: " << guard.report();
  for (int i = 0; i < 100; ++i) guard.watch(code);
  EXPECT_EQ(guard.violations(), 0u) << function << ": " << guard.report();
}

/// The same for what a testing::Harness does in the thread of its component; the bench itself may
/// allocate.
template <typename Code>
void expect_realtime_on_bench(const char* model, Code&& code) {
  const testing::RealtimeGuard guard;
  for (int i = 0; i < 100; ++i) code();
  EXPECT_EQ(guard.violations(), 0u) << model << ": " << guard.report();
}

}  // namespace armature
