// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/rt/alarms.hpp"
#include "armature/testing/model/explore.hpp"
#include "armature/testing/model/mutants.hpp"

namespace armature::rt {
namespace {

namespace model = testing::model;
using ::testing::HasSubstr;

base::Time at(int nanoseconds) { return base::Time(base::Duration(nanoseconds)); }

/// The sleeper was woken once before; it sets these times, then sleeps. The watch sleeps until the
/// next time, which then is now. A time that is lost leaves the sleeper asleep.
template <typename Parker, template <typename> class AnyAlarms>
model::Result check_alarms(const std::vector<int>& times) {
  return model::explore([&times](model::Program& program) {
    AnyAlarms<Parker> alarms;
    BasicWakeup<Parker> sleeper;
    const std::size_t number = alarms.add(sleeper);
    alarms.set(number, at(1));
    alarms.ring(at(1));
    sleeper.wait();
    program.thread("sleeper", [&] {
      for (const int due : times) alarms.set(number, at(due));
      sleeper.wait();
    });
    program.thread("watch", [&] {
      base::Time now = at(1);
      for (bool rang = false; !rang;) {
        const base::Time next = alarms.ring(now);
        if (!alarms.wait_until(next)) now = next;
        rang = now > at(1) && alarms.ring(now) == base::Time::max();
      }
    });
    program.join();
  });
}

TEST(AlarmsModel, NoSleeperIsLeftAsleep) {
  const model::Result one = check_alarms<model::Parker, BasicAlarms>({2});
  EXPECT_EQ(one.failure, "");
  const model::Result put_off = check_alarms<model::Parker, BasicAlarms>({2, 3});
  EXPECT_EQ(put_off.failure, "");
  EXPECT_GT(std::min(one.executions, put_off.executions), 50u);
  RecordProperty("executions", static_cast<int>(one.executions + put_off.executions));
}

template <typename Atomics>
model::Result check_alarms_of() {
  return check_alarms<model::ParkerOf<Atomics>, BasicAlarms>({2});
}

TEST(AlarmsModel, TheCheckFindsMistakesOfItsParts) {
  const char* const asleep = "sleeps for ever";
  EXPECT_THAT(check_alarms_of<model::AtomicsWithoutRelease>().failure, HasSubstr(asleep));
  EXPECT_THAT(check_alarms_of<model::AtomicsWithoutAcquire>().failure, HasSubstr(asleep));
  EXPECT_THAT(check_alarms_of<model::AtomicsInTwoSteps>().failure, HasSubstr(asleep));
}

/// Tells the watch of the first time only: whoever is woken then, and sets another, is forgotten.
template <typename Parker>
class TellsOnce : public BasicAlarms<Parker> {
 public:
  void set(std::size_t sleeper, base::Time due) {
    if (told_) return;
    told_ = true;
    BasicAlarms<Parker>::set(sleeper, due);
  }

 private:
  bool told_ = false;
};

TEST(AlarmsModel, TheCheckFindsATimeOfWhichTheWatchWasNotTold) {
  const model::Result result = check_alarms<model::Parker, TellsOnce>({2});
  EXPECT_THAT(result.failure, HasSubstr("sleeps for ever"));
}

}  // namespace
}  // namespace armature::rt
