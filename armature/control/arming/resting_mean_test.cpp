// SPDX-License-Identifier: Apache-2.0
#include "armature/control/arming/resting_mean.hpp"

#include <array>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::control {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(RestingMean, IsNothingBeforeTheFirstSampleAndInMotion) {
  RestingMean mean(2, 20);
  EXPECT_THAT(mean.get(), IsEmpty());
  mean.add(std::array{1.0, 2.0}, true);
  EXPECT_THAT(mean.get(), ElementsAre(1.0, 2.0));
  mean.add(std::array{1.0, 2.0}, false);
  EXPECT_THAT(mean.get(), IsEmpty());
}

TEST(RestingMean, LeavesOutTheNoiseOfSingleSamples) {
  RestingMean mean(1, 20);
  for (int k = 0; k < 200; ++k) mean.add(std::array{k % 2 == 0 ? 5.0 : -3.0}, true);
  EXPECT_THAT(mean.get(), ElementsAre(DoubleNear(1.0, 0.2)));
}

TEST(RestingMean, FollowsWhatChanges) {
  RestingMean mean(1, 20);
  for (int k = 0; k < 1000; ++k) mean.add(std::array{0.0}, true);
  for (int k = 0; k < 100; ++k) mean.add(std::array{1.0}, true);
  EXPECT_THAT(mean.get(), ElementsAre(DoubleNear(1.0, 0.01)));
}

TEST(RestingMean, BeginsAnewAfterAMotion) {
  RestingMean mean(1, 20);
  for (int k = 0; k < 100; ++k) mean.add(std::array{7.0}, true);
  mean.add(std::array{7.0}, false);
  mean.add(std::array{1.0}, true);
  EXPECT_THAT(mean.get(), ElementsAre(1.0));
}

}  // namespace
}  // namespace armature::control
