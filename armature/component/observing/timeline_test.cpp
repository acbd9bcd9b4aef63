// SPDX-License-Identifier: Apache-2.0
#include "armature/component/observing/timeline.hpp"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/author.hpp"
#include "armature/rt/ticks.hpp"

namespace armature::component {
namespace {

using ::testing::ElementsAre;
using Kind = Timeline::Entry::Kind;

class Part : public Component {
 public:
  using Component::Component;
};

constexpr base::Time kNow = base::time_from_ns(1'000);

std::uint64_t ticks_of(base::Duration duration) {
  return static_cast<std::uint64_t>(static_cast<double>(duration.count()) / rt::tick_period_ns());
}

std::vector<std::string> taken(Timeline& timeline) {
  std::vector<std::string> all;
  while (const Timeline::Entry* entry = timeline.pop()) {
    if (entry->kind == Kind::kOpen) all.push_back("open " + std::to_string(entry->begin));
    if (entry->kind == Kind::kClose) all.push_back("close " + std::to_string(entry->end));
    if (entry->kind != Kind::kStep) continue;
    all.push_back(entry->component->name() + " " + std::to_string(entry->begin) + "-" +
                  std::to_string(entry->end));
  }
  return all;
}

constexpr base::Duration kPlenty = std::chrono::seconds(1);

TEST(Timeline, StepsOfOneComponentThatFollowEachOtherAreOne) {
  const Part a("A");
  const Part b("B");
  Timeline timeline({.burst = kPlenty});
  timeline.open(0, kNow, 100);
  timeline.add_step(&a, 100, 110);
  timeline.add_step(&a, 110, 120);
  timeline.add_step(&b, 120, 130);
  timeline.add_step(nullptr, 130, 140);
  timeline.add_step(&b, 140, 150);
  timeline.close(160, 1, kNow, true, true);
  EXPECT_THAT(taken(timeline),
              ElementsAre("open 100", "A 100-120", "B 120-130", "B 140-150", "close 160"));
}

TEST(Timeline, WhatFindsNoRoomIsCounted) {
  const Part a("A");
  const Part b("B");
  Timeline timeline({.capacity = 3, .burst = kPlenty});
  timeline.open(0, kNow, 100);
  timeline.add_step(&a, 100, 110);
  timeline.add_step(&b, 110, 120);
  timeline.add_step(&a, 120, 130);
  timeline.close(140, 1, kNow, true, true);
  EXPECT_EQ(timeline.dropped(), 2u);
  EXPECT_THAT(taken(timeline), ElementsAre("open 100", "A 100-110", "B 110-120"));
}

TEST(Timeline, OfAStretchThatFoundNoRoomNothingIsKeptAndTheNextSaysSo) {
  const Part a("A");
  Timeline timeline({.capacity = 1, .burst = kPlenty});
  timeline.open(0, kNow, 100);
  timeline.open(0, kNow, 200);
  timeline.add_step(&a, 200, 210);
  timeline.close(220, 2, kNow, true, true);
  EXPECT_THAT(taken(timeline), ElementsAre("open 100"));
  timeline.open(0, kNow, 300);
  const Timeline::Entry* const next = timeline.pop();
  ASSERT_NE(next, nullptr);
  EXPECT_EQ(next->begin, 300u);
  EXPECT_EQ(next->missing, 1u);
}

TEST(Timeline, StepsCostNoMoreThanTheirShareOfTheTime) {
  const Part a("A");
  const Part b("B");
  constexpr int kSteps = 100;
  const std::uint64_t cycle = ticks_of(std::chrono::microseconds(10));
  Timeline timeline({.capacity = 4 * kSteps, .share = 0.1});
  int detailed = 0;
  std::uint64_t now = 1;
  constexpr int kCycles = 10'000;
  for (int i = 0; i < kCycles; ++i, now += cycle) {
    timeline.open(0, kNow, now);
    const bool affords = timeline.affords_steps();
    detailed += affords ? 1 : 0;
    for (std::uint64_t step = 0; affords && step < kSteps; ++step) {
      timeline.add_step(step % 2 == 0 ? &a : &b, now + step, now + step + 1);
    }
    timeline.close(now + kSteps, static_cast<std::uint64_t>(i), kNow, true, affords);
    while (timeline.pop() != nullptr) continue;
  }
  // 0.97 us of each cycle pay for steps that cost 15 us.
  EXPECT_NEAR(detailed, kCycles * 0.97 / 15.0, kCycles * 0.01);
  EXPECT_EQ(timeline.dropped(), 0u);
}

TEST(Timeline, WhereEvenAStretchCostsTooMuchItIsLeftOutAndCounted) {
  const std::uint64_t cycle = ticks_of(std::chrono::nanoseconds(150));
  Timeline timeline({.share = 0.1});
  std::uint64_t kept = 0;
  std::uint64_t missing = 0;
  constexpr std::uint64_t kCycles = 10'000;
  for (std::uint64_t i = 1; i <= kCycles; ++i) {
    timeline.open(0, kNow, i * cycle);
    timeline.close(i * cycle + 1, i, kNow, true, false);
    while (const Timeline::Entry* entry = timeline.pop()) {
      if (entry->kind != Kind::kOpen) continue;
      ++kept;
      missing += entry->missing;
    }
  }
  EXPECT_NEAR(static_cast<double>(kept), kCycles / 2.0, kCycles * 0.1);  // 15 ns of 30
  EXPECT_NEAR(static_cast<double>(kept + missing), kCycles, 5.0);
}

TEST(Timeline, WhatOthersSpendForItIsPaidForLikeItsOwn) {
  Timeline timeline({.burst = kPlenty});
  timeline.open(0, kNow, 1);
  EXPECT_TRUE(timeline.affords_steps());
  timeline.close(2, 1, kNow, true, true);
  timeline.spend(ticks_of(kPlenty) * 2);
  timeline.open(0, kNow, 3);
  EXPECT_FALSE(timeline.affords_steps());
}

}  // namespace
}  // namespace armature::component
