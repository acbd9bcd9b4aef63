// SPDX-License-Identifier: Apache-2.0
#include "armature/sim/encoder.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace armature::sim {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

TEST(Encoder, CountsTheTurnsOfTheMotor) {
  const Encoder encoder(2000.0, 100.0);
  EXPECT_EQ(encoder.count(0.0), 0);
  EXPECT_EQ(encoder.count(kTurn / 100.0), 2000);
  EXPECT_EQ(encoder.count(kTurn * 0.25), 50'000);
}

TEST(Encoder, ACountIsTheSameStepInBothDirections) {
  const Encoder encoder(2000.0, 100.0);
  const double count = kTurn / 200'000.0;
  EXPECT_EQ(encoder.count(0.49 * count), 0);
  EXPECT_EQ(encoder.count(0.51 * count), 1);
  EXPECT_EQ(encoder.count(1.51 * count), 2);
  EXPECT_EQ(encoder.count(-0.49 * count), 0);
  EXPECT_EQ(encoder.count(-0.51 * count), -1);
  EXPECT_EQ(encoder.count(-1.51 * count), -2);
}

TEST(Encoder, DisplacementsAddUpToThePositionHoweverManyThereAre) {
  Encoder encoder(2000.0, 100.0);
  std::mt19937_64 random(42);
  std::uniform_real_distribution<double> step(-1e-4, 1.5e-4);
  double position = 0.0;
  std::int64_t sum = 0;
  for (int i = 0; i < 1'000'000; ++i) {
    position += step(random);
    sum += encoder.displacement(position);
  }
  EXPECT_EQ(sum, encoder.count(position));
  EXPECT_GT(sum, 100'000);
}

TEST(Encoder, AfterARestartDisplacementsCountFromThere) {
  Encoder encoder(2000.0, 100.0);
  encoder.restart(1.0);
  EXPECT_EQ(encoder.displacement(1.0), 0);
  EXPECT_EQ(encoder.displacement(0.0), -encoder.count(1.0));
}

}  // namespace
}  // namespace armature::sim
