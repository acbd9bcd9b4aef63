// SPDX-License-Identifier: Apache-2.0
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/rt/try_lock.hpp"
#include "armature/testing/model/explore.hpp"
#include "armature/testing/model/mutants.hpp"

namespace armature::rt {
namespace {

namespace model = testing::model;
using ::testing::HasSubstr;

/// Two threads add to a plain number, each behind the lock or not at all.
template <typename Lock>
model::Result check_lock() {
  return model::explore([](model::Program& program) {
    Lock lock;
    model::Data<int> sum = 0;
    int added[2] = {0, 0};
    const auto add = [&](int& mine) {
      for (int round = 0; round < 2; ++round) {
        if (!lock.try_lock()) continue;
        sum = sum + 1;
        ++mine;
        lock.unlock();
      }
    };
    program.thread("writer", [&] { add(added[0]); });
    program.thread("other", [&] { add(added[1]); });
    program.join();
    program.expect(lock.try_lock(), "the lock stayed taken");
    program.expect(sum == added[0] + added[1], "two had the lock at once");
    program.expect(added[0] + added[1] > 0, "nobody got the lock");
  });
}

TEST(TryLockModel, NoTwoHaveItAndTheNextSeesWhatTheLastDid) {
  const model::Result result = check_lock<BasicTryLock<model::Atomics>>();
  EXPECT_EQ(result.failure, "");
  EXPECT_GT(result.executions, 20u);
}

TEST(TryLockModel, TheCheckFindsMissingMemoryOrders) {
  EXPECT_THAT(check_lock<BasicTryLock<model::AtomicsWithoutRelease>>().failure,
              HasSubstr("data race"));
  EXPECT_THAT(check_lock<BasicTryLock<model::AtomicsWithoutAcquire>>().failure,
              HasSubstr("data race"));
}

/// Looks and takes in two steps.
template <typename Atomics>
class LooksFirst {
 public:
  bool try_lock() {
    if (taken_.load(std::memory_order_acquire) != 0) return false;
    taken_.store(1, std::memory_order_relaxed);
    return true;
  }
  void unlock() { taken_.store(0, std::memory_order_release); }

 private:
  typename Atomics::template Atomic<std::uint32_t> taken_{0};
};

TEST(TryLockModel, TheCheckFindsALockThatLooksBeforeItTakes) {
  EXPECT_NE(check_lock<LooksFirst<model::Atomics>>().failure, "");
}

}  // namespace
}  // namespace armature::rt
