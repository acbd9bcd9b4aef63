// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/task.hpp"

#include <memory>
#include <thread>

#include <gtest/gtest.h>

#include "armature/exec/engine.hpp"
#include "armature/platform/clock.hpp"

namespace armature::exec {
namespace {

using namespace std::chrono_literals;

/// An engine whose thread really runs.
class RunningEngine {
 public:
  RunningEngine() : engine_("engine", Activity::triggered(), {}, {}) {
    engine_.begin({});
    thread_ = std::thread([this] { engine_.serve(); });
  }
  ~RunningEngine() {
    engine_.end();
    thread_.join();
  }
  component::ExecutionContext& context() { return engine_.context(); }
  std::thread::id id() const { return thread_.get_id(); }

 private:
  Engine engine_;
  std::thread thread_;
};

TEST(Task, IsDoneByTheThreadOfTheContextBeforeRunInReturns) {
  RunningEngine engine;
  std::thread::id where;
  EXPECT_TRUE(Task::run_in(
      engine.context(), [&] { where = std::this_thread::get_id(); }, 60s));
  EXPECT_EQ(where, engine.id());
}

TEST(Task, SeveralAreDoneInTheirOrder) {
  RunningEngine engine;
  std::string order;
  Task::post(engine.context(), [&] { order += 'a'; });
  Task::post(engine.context(), [&] { order += 'b'; });
  EXPECT_TRUE(Task::run_in(
      engine.context(), [&] { order += 'c'; }, 60s));
  EXPECT_EQ(order, "abc");
}

TEST(Task, ThatIsNotDoneInTimeIsDoneLaterAndThenGone) {
  Engine engine("engine", Activity::triggered(), {}, {});
  const auto owned = std::make_shared<int>(0);
  EXPECT_FALSE(Task::run_in(
      engine.context(), [owned] { ++*owned; }, 1ms));
  EXPECT_EQ(*owned, 0);
  EXPECT_EQ(owned.use_count(), 2);
  engine.step({});
  EXPECT_EQ(*owned, 1);
  EXPECT_EQ(owned.use_count(), 1) << "nothing is left of it";
}

TEST(Task, IsNotWaitedForOnceThatIsInVain) {
  Engine engine("engine", Activity::triggered(), {}, {});
  const base::Time begin = platform::monotonic_now();
  int asked = 0;
  EXPECT_FALSE(Task::run_in(
      engine.context(), [] {}, 60s, [&] { return ++asked == 3; }));
  EXPECT_LT(platform::monotonic_now(), begin + 30s);
  engine.step({});
}

TEST(Task, IsDoneEvenIfItArrivedAfterTheThreadHadEnded) {
  Engine engine("engine", Activity::triggered(), {}, {});
  engine.end();
  engine.serve();
  bool done = false;
  Task::post(engine.context(), [&] { done = true; });
  EXPECT_TRUE(engine.has_leftovers());
  engine.deliver_leftovers();
  EXPECT_TRUE(done);
  EXPECT_FALSE(engine.has_leftovers());
}

}  // namespace
}  // namespace armature::exec
