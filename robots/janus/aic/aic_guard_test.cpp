// SPDX-License-Identifier: Apache-2.0
#include "robots/janus/aic/aic_guard.hpp"

#include <chrono>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "robots/janus/test_bench.hpp"

namespace armature::janus {
namespace {

guardian::Orders orders() {
  return guard_orders({1, 2}, "can0", kBitRate, std::chrono::milliseconds(10));
}

/// The devices of which an answer has been on the wire since the last call.
std::vector<bool> take_idle(Bench& bench) {
  std::vector<bool> idle(2);
  for (const can::WireEvent& event : bench.log) {
    for (const guardian::IdleAnswer& answer : orders().answers) {
      bool matches = event.frame.id == answer.frame.id;
      for (std::size_t i = 0; matches && i < answer.mask.size(); ++i) {
        matches = ((event.frame.data[i] ^ answer.frame.data[i]) & answer.mask[i]) == 0;
      }
      if (matches) idle[answer.device] = true;
    }
  }
  bench.log.clear();
  return idle;
}

TEST(AicGuard, SwitchesACardThatIsDrivenOffAndBrakesIt) {
  Running bench;
  EXPECT_GT(bench.joint.motor, 0.0);
  for (const can::Frame& frame : orders().safe) bench.tell(frame);
  EXPECT_EQ(bench.joint.motor, FakeWiring::kOff);
  EXPECT_FALSE(bench.joint.brake_released);
}

TEST(AicGuard, HasNoFrameThatSwitchesAnythingOnOrReleasesABrake) {
  Bench bench;
  const guardian::Orders all = orders();
  for (const auto* frames : {&all.safe, &all.questions}) {
    for (const can::Frame& frame : *frames) {
      bench.tell(frame);
      for (const FakeWiring& joint : bench.joints) {
        EXPECT_EQ(joint.motor, FakeWiring::kOff);
        EXPECT_FALSE(joint.brake_released);
      }
    }
  }
}

TEST(AicGuard, KnowsByItsAnswerWhetherACardIsOff) {
  Running bench;
  const guardian::Orders all = orders();
  for (const can::Frame& frame : all.questions) bench.tell(frame);
  EXPECT_EQ(take_idle(bench), (std::vector<bool>{false, true}));  // card 2 was never on
  for (const can::Frame& frame : all.safe) bench.tell(frame);
  take_idle(bench);
  for (const can::Frame& frame : all.questions) bench.tell(frame);
  EXPECT_EQ(take_idle(bench), (std::vector<bool>{true, true}));
}

TEST(AicGuard, ItsOrdersCanBeFollowedForSixteenCards) {
  std::vector<int> cards;
  for (int card = 1; card <= 16; ++card) cards.push_back(card);
  EXPECT_EQ(
      guardian::problem_of(guard_orders(cards, "can0", kBitRate, std::chrono::milliseconds(10))),
      "");
}

}  // namespace
}  // namespace armature::janus
