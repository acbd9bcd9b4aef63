// SPDX-License-Identifier: Apache-2.0
#include "armature/remote/control_queue.hpp"

#include <memory>
#include <string>

#include <gtest/gtest.h>

namespace armature::remote {
namespace {

TEST(ControlQueue, DoesWhatWaitedInItsOrderAndWhatThatAskedForTheNextTime) {
  ControlQueue queue;
  std::string done;
  EXPECT_TRUE(queue.post([&] {
    done += 'a';
    EXPECT_TRUE(queue.post([&] { done += 'c'; }));
  }));
  EXPECT_TRUE(queue.post([&] { done += 'b'; }));
  queue.run();
  EXPECT_EQ(done, "ab");
  queue.run();
  EXPECT_EQ(done, "abc");
}

TEST(ControlQueue, RefusesWhatItHasNoRoomFor) {
  ControlQueue queue;
  int done = 0;
  for (std::size_t i = 0; i < ControlQueue::kCapacity; ++i) {
    ASSERT_TRUE(queue.post([&] { ++done; }));
  }
  EXPECT_FALSE(queue.post([&] { ++done; }));
  queue.run();
  EXPECT_EQ(done, static_cast<int>(ControlQueue::kCapacity));
}

TEST(ControlQueue, LetsGoOfWhatWaitsWhenItIsClosed) {
  ControlQueue queue;
  const auto kept = std::make_shared<int>(0);
  ASSERT_TRUE(queue.post([kept] { ++*kept; }));
  queue.close();
  EXPECT_EQ(kept.use_count(), 1);
  EXPECT_FALSE(queue.post([kept] { ++*kept; }));
  queue.run();
  EXPECT_EQ(*kept, 0);
}

}  // namespace
}  // namespace armature::remote
