// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/internal/application/threads.hpp"

#include <atomic>

#include <gtest/gtest.h>

#include "armature/component/host.hpp"
#include "armature/exec/internal/application/test_parts.hpp"
#include "armature/exec/task.hpp"

namespace armature::exec::internal {
namespace {

class ThreadsTest : public ::testing::Test {
 protected:
  static Blueprint two() {
    Blueprint blueprint;
    blueprint.add<Counter>("A", Activity::triggered());
    blueprint.add<Counter>("B", Activity::triggered());
    return blueprint;
  }
  void begin() {
    for (const auto& engine : parts_.engines) engine->begin({});
  }

  PlannedParts parts_{two(), false};
  const ApplicationOptions options_ = patient(false);
  Threads threads_{options_, parts_.plan, parts_.engines, parts_.unreachable};
  base::Diagnostics diagnostics_;
};

TEST_F(ThreadsTest, ServeTheirEnginesFromGoToEnd) {
  ASSERT_TRUE(threads_.prepare(diagnostics_));
  EXPECT_EQ(threads_.verdict().lines.size(), 2u) << "a line for each, and none that is not asked";
  begin();
  threads_.go();
  std::atomic<int> done{0};
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_TRUE(Task::run_in(
        component::Host::context(parts_.component(i)), [&] { ++done; }, 60s));
  }
  EXPECT_EQ(done, 2);
  threads_.end(diagnostics_);
  EXPECT_EQ(diagnostics_.to_text(), "");
  EXPECT_FALSE(component::Host::context(parts_.component(0)).live);
  EXPECT_FALSE(parts_.unreachable.any());
}

TEST_F(ThreadsTest, EndWithoutHavingServedIfTheyNeverWent) {
  ASSERT_TRUE(threads_.prepare(diagnostics_));
  begin();
  std::atomic<int> done{0};
  Task::post(component::Host::context(parts_.component(0)), [&] { ++done; });
  threads_.end(diagnostics_);
  EXPECT_EQ(done, 0);
  EXPECT_EQ(diagnostics_.to_text(), "");
  parts_.engine_of(0).deliver_leftovers();
  EXPECT_EQ(done, 1);
}

TEST_F(ThreadsTest, CanBePreparedAgain) {
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(threads_.prepare(diagnostics_));
    threads_.end(diagnostics_);
  }
  EXPECT_EQ(threads_.verdict().lines.size(), 2u);
}

}  // namespace
}  // namespace armature::exec::internal
