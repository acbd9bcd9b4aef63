// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/own_priority.hpp"

#include <gtest/gtest.h>

#include "armature/platform/thread.hpp"

namespace armature::platform {
namespace {

TEST(OwnPriority, IsThatOfTheThreadItself) {
  bool granted = false;
  int before = -1;
  int after = -1;
  ThreadRequest request;
  request.name = "urgent";
  request.prefault = false;
  Thread(request, [&] {
    before = own_priority();
    granted = set_own_priority(7) && set_own_priority(5);
    after = own_priority();
  }).join();
  EXPECT_EQ(before, 0);
  EXPECT_EQ(own_priority(), 0) << "of another thread";
  if (!granted) GTEST_SKIP() << "the system grants no real-time priority";
  EXPECT_EQ(after, 5);
}

TEST(OwnPriority, OneThatThereIsNotIsRefused) {
  EXPECT_FALSE(set_own_priority(100));
  EXPECT_FALSE(set_own_priority(0));
  EXPECT_EQ(own_priority(), 0);
}

}  // namespace
}  // namespace armature::platform
