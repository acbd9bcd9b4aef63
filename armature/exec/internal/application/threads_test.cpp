// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/internal/application/threads.hpp"

#include <atomic>
#include <cstdint>
#include <memory>
#include <utility>

#include <gtest/gtest.h>

#include "armature/component/host.hpp"
#include "armature/exec/internal/application/test_parts.hpp"
#include "armature/exec/task.hpp"
#include "armature/platform/clock.hpp"

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

// --- threads of shadows --------------------------------------------------------------------------

class Updated final : public component::Component {
 public:
  using Component::Component;
  std::uint64_t updates = 0;

 private:
  void on_update() override { ++updates; }
};

/// A controller, and a shadow beside it.
PlannedParts& with_shadow(std::unique_ptr<PlannedParts>& parts, base::Duration period) {
  Blueprint blueprint;
  blueprint.add<Counter>("Driving", Activity::periodic(5ms, 50));
  blueprint.add<Updated>("Shadow", Activity::periodic(period, 5));
  blueprint.components[1].shadow = true;
  parts = std::make_unique<PlannedParts>(std::move(blueprint), false);
  return *parts;
}

TEST(ThreadsOfShadows, SleepThroughIfTheyRunAsOftenAsAllOthers) {
  std::unique_ptr<PlannedParts> parts;
  EXPECT_TRUE(with_shadow(parts, 5ms).engine_of(1).sleeps_through());
  EXPECT_FALSE(parts->engine_of(0).sleeps_through());
  EXPECT_FALSE(with_shadow(parts, 10ms).engine_of(1).sleeps_through());
}

TEST(ThreadsOfShadows, TakeMessagesInTheirCyclesAndAreWokenByNone) {
  std::unique_ptr<PlannedParts> parts;
  with_shadow(parts, 5ms);
  const ApplicationOptions options = patient(false);
  Threads threads{options, parts->plan, parts->engines, parts->unreachable};
  base::Diagnostics diagnostics;
  ASSERT_TRUE(threads.prepare(diagnostics));
  auto& shadow = dynamic_cast<Updated&>(parts->component(1));
  component::ExecutionContext& context = component::Host::context(shadow);
  ASSERT_TRUE(component::Host::configure(shadow));
  ASSERT_TRUE(component::Host::start(shadow));
  for (const auto& engine : parts->engines) engine->begin(parts->clock.now());
  threads.go();
  int in_cycles = 0;  // their number has gone up, and the update is still to come
  constexpr int kMessages = 50;
  for (int i = 0; i < kMessages; ++i) {
    platform::sleep_until(platform::monotonic_now() + 1ms);
    Task::post(context, [&] { in_cycles += context.cycle > shadow.updates ? 1 : 0; });
  }
  threads.end(diagnostics);
  EXPECT_EQ(diagnostics.to_text(), "");
  EXPECT_GT(in_cycles, kMessages / 2);  // between two cycles, all of them would be equal
}

}  // namespace
}  // namespace armature::exec::internal
