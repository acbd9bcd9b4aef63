// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/internal/application/pacer.hpp"

#include <chrono>

#include <gtest/gtest.h>

namespace armature::exec::internal {
namespace {

using namespace std::chrono_literals;
using base::Time;

constexpr Time kReal{100s};
constexpr Time kSimulated{5s};

TEST(Pacer, WaitsForNothingUnlessTold) {
  const Pacer pacer;
  EXPECT_LT(pacer.time_of(kSimulated), Time{});
}

TEST(Pacer, HoldsTimeBackToItsRate) {
  Pacer pacer;
  pacer.set(0.5, kSimulated, kReal);
  EXPECT_EQ(pacer.time_of(kSimulated), kReal);
  EXPECT_EQ(pacer.time_of(kSimulated + 10ms), kReal + 20ms);
  pacer.set(4.0, kSimulated, kReal);
  EXPECT_EQ(pacer.time_of(kSimulated + 10ms), kReal + 2500us);
}

TEST(Pacer, AHundredthOfRealTimeEndsNowhereBeforeTheEndOfTime) {
  Pacer pacer;
  pacer.set(0.01, kSimulated, kReal);
  EXPECT_EQ(pacer.time_of(Time::max()), Time::max());
}

TEST(Pacer, PausedTimePassesByStepsOnly) {
  Pacer pacer;
  pacer.pause();
  EXPECT_EQ(pacer.time_of(kSimulated), Time::max());
  pacer.step();
  pacer.step();
  EXPECT_LT(pacer.time_of(kSimulated), Time{});
  pacer.arrive(kSimulated, kReal);
  pacer.arrive(kSimulated + 1ms, kReal);
  EXPECT_EQ(pacer.time_of(kSimulated + 2ms), Time::max());
}

TEST(Pacer, AfterAPauseItGoesOnAtItsRateFromThere) {
  Pacer pacer;
  pacer.set(2.0, kSimulated, kReal);
  pacer.pause();
  pacer.resume(kSimulated + 1s, kReal + 60s);
  EXPECT_EQ(pacer.time_of(kSimulated + 2s), kReal + 60s + 500ms);
  EXPECT_EQ(pacer.pace(), (Pace{2.0, false}));
}

TEST(Pacer, StepsThatWereLeftEndWithThePause) {
  Pacer pacer;
  pacer.pause();
  pacer.step();
  pacer.resume(kSimulated, kReal);
  pacer.pause();
  EXPECT_EQ(pacer.time_of(kSimulated), Time::max());
}

TEST(Pacer, WhatTheMachineCannotKeepUpWithIsNotMadeUpFor) {
  Pacer pacer;
  pacer.set(1.0, kSimulated, kReal);
  pacer.arrive(kSimulated + 10ms, kReal + 40ms);
  EXPECT_EQ(pacer.time_of(kSimulated + 20ms), kReal + 20ms) << "30 ms late are caught up with";
  pacer.arrive(kSimulated + 20ms, kReal + 2s);
  EXPECT_EQ(pacer.time_of(kSimulated + 30ms), kReal + 2s + 10ms);
}

}  // namespace
}  // namespace armature::exec::internal
