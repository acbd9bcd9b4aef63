// SPDX-License-Identifier: Apache-2.0
#include "armature/guardian/internal/watch.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace armature::guardian::internal {
namespace {

constexpr std::int64_t kPeriod = 2 * kMillisecond;
constexpr std::int64_t kBegin = 1'000'000 * kMillisecond;

/// A guardian and its process, in a time that the test lets pass.
class Bench {
 public:
  /// The guardian looks whenever it wants to, and the process runs its cycles, until `end`; how
  /// often something was sent.
  int run_until(std::int64_t end) {
    int sent = 0;
    while (sight_.now < end) {
      const std::int64_t next_beat = runs_ ? sight_.beat + kPeriod : end;
      sight_.now = std::min({std::max(watch_.next(), sight_.now + 1), next_beat, end});
      if (runs_ && sight_.now == next_beat) sight_.beat = sight_.now;
      if (sight_.now >= watch_.next()) sent += look() == Act::kSend ? 1 : 0;
    }
    return sent;
  }
  Act look() {
    last_ = watch_.look(sight_);
    if (last_ == Act::kSend && sent_at_ == 0) sent_at_ = sight_.now;
    return last_;
  }

  Sight sight_{.now = kBegin, .beat = kBegin, .watched = true};
  Watch watch_{kPeriod};
  bool runs_ = true;
  Act last_ = Act::kNothing;
  std::int64_t sent_at_ = 0;
};

TEST(Watch, SendsNothingWhileCyclesAreRun) {
  Bench bench;
  EXPECT_EQ(bench.run_until(kBegin + 10'000 * kMillisecond), 0);
  EXPECT_EQ(bench.watch_.acted(), 0u);
}

TEST(Watch, SendsAfterThreePeriodsWithoutACycle) {
  Bench bench;
  bench.run_until(kBegin + 100 * kPeriod);
  bench.runs_ = false;
  const std::int64_t last = bench.sight_.beat;
  EXPECT_GT(bench.run_until(last + 5 * kPeriod), 0);
  EXPECT_EQ(bench.sent_at_, last + kMostMissedPeriods * kPeriod);
  EXPECT_EQ(bench.watch_.cause(), Cause::kNoCycle);
  EXPECT_EQ(bench.watch_.silence(), kMostMissedPeriods * kPeriod);
}

TEST(Watch, SendsAtOnceWhenTheProcessDiesWhetherCyclesAreExpectedOrNot) {
  for (const bool watched : {true, false}) {
    Bench bench;
    bench.sight_.watched = watched;
    bench.look();
    bench.sight_.now += 1;
    bench.sight_.dead = true;
    EXPECT_EQ(bench.look(), Act::kSend);
    EXPECT_EQ(bench.watch_.cause(), Cause::kDeath);
  }
}

TEST(Watch, GoesOnInEachPeriodUntilTheDrivesAreIdleAndThenEnds) {
  Bench bench;
  bench.sight_.dead = true;
  bench.runs_ = false;
  const int sent = bench.run_until(kBegin + 10 * kPeriod);
  EXPECT_GE(sent, 9);
  EXPECT_LE(sent, 11);
  bench.sight_.idle = true;
  EXPECT_EQ(bench.look(), Act::kEnd);
}

TEST(Watch, GivesUpOnDrivesThatDoNotAnswerAfterThirtySecondsAndOnABusThatIsGoneAfterTwo) {
  for (const bool bus : {true, false}) {
    Bench bench;
    bench.sight_.dead = true;
    bench.sight_.bus = bus;
    bench.runs_ = false;
    const std::int64_t limit = bus ? kMostInsistence : kMostWithoutBus;
    bench.run_until(kBegin + limit);
    EXPECT_NE(bench.last_, Act::kGiveUp);
    bench.run_until(kBegin + limit + 3 * kPeriod);
    EXPECT_EQ(bench.last_, Act::kGiveUp);
  }
}

TEST(Watch, EndsWhenTheProcessHasEndedInOrderAlsoIfItIsDeadByThen) {
  Bench bench;
  bench.sight_.ended = true;
  bench.sight_.dead = true;
  EXPECT_EQ(bench.look(), Act::kEnd);
  EXPECT_EQ(bench.watch_.acted(), 0u);
}

TEST(Watch, ExpectsNoCyclesOfAProcessThatRests) {
  Bench bench;
  bench.sight_.watched = false;
  bench.runs_ = false;
  EXPECT_EQ(bench.run_until(kBegin + 10'000 * kMillisecond), 0);
}

TEST(Watch, AProcessThatGoesOnDoesNotEndItsActingBeforeItSaysThatItKnows) {
  Bench bench;
  bench.runs_ = false;
  bench.run_until(kBegin + 10 * kPeriod);
  ASSERT_EQ(bench.watch_.acted(), 1u);
  bench.runs_ = true;
  bench.sight_.beat = bench.sight_.now;
  EXPECT_GT(bench.run_until(kBegin + 20 * kPeriod), 0);
  bench.sight_.idle = true;
  EXPECT_GT(bench.run_until(kBegin + 20 * kPeriod + 5 * kReminder), 0);
  bench.sight_.acknowledged = 1;
  EXPECT_EQ(bench.run_until(kBegin + 100 * kPeriod), 0);
  EXPECT_EQ(bench.watch_.acted(), 1u);
}

TEST(Watch, ThatWasLateItselfGivesTheProcessAnotherPeriod) {
  Bench bench;
  bench.run_until(kBegin + 100 * kPeriod);
  // The machine stood still for both.
  bench.sight_.now += 20 * kMillisecond;
  EXPECT_EQ(bench.look(), Act::kNothing);
  EXPECT_EQ(bench.watch_.next(), bench.sight_.now + kPeriod);
  bench.sight_.beat = bench.sight_.now + kPeriod / 2;
  bench.sight_.now += kPeriod;
  EXPECT_EQ(bench.look(), Act::kNothing);
  EXPECT_EQ(bench.watch_.acted(), 0u);
}

TEST(Watch, ThatIsLateAgainAndAgainActsBeforeTheDrivesWatchdogs) {
  Bench bench;
  bench.run_until(kBegin + 100 * kPeriod);
  const std::int64_t last = bench.sight_.beat;
  while (bench.look() != Act::kSend) bench.sight_.now += 10 * kMillisecond;
  EXPECT_LE(bench.sight_.now, last + kMostPatience + 10 * kMillisecond);
}

TEST(Watch, ACycleOfTheFutureIsNone) {
  Bench bench;
  bench.look();
  bench.runs_ = false;
  bench.sight_.beat = kBegin + 1'000'000 * kMillisecond;
  EXPECT_GT(bench.run_until(kBegin + 10 * kPeriod), 0);
}

}  // namespace
}  // namespace armature::guardian::internal
