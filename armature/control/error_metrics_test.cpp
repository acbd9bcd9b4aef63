// SPDX-License-Identifier: Apache-2.0
#include "armature/control/error_metrics.hpp"

#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace armature::control {
namespace {

using namespace std::chrono_literals;

ErrorMetrics make(std::size_t joints, base::Duration period) {
  return ErrorMetrics::make({joints, period}).value();
}

TEST(ErrorMetrics, OfAConstantErrorAreExact) {
  ErrorMetrics metrics = make(2, 10ms);
  for (int k = 0; k <= 200; ++k) metrics.step(std::array{-0.5, 0.0});
  const auto& first = metrics.of(0);  // over T = 2 s: T |e|, T^2 |e| / 2, T e^2, T^2 e^2 / 2
  EXPECT_NEAR(first.iae, 1.0, 1e-12);
  EXPECT_NEAR(first.itae, 1.0, 1e-12);
  EXPECT_NEAR(first.ise, 0.5, 1e-12);
  EXPECT_NEAR(first.itse, 0.5, 1e-12);
  EXPECT_EQ(first.largest, 0.5);
  EXPECT_EQ(first.last, -0.5);
  EXPECT_EQ(metrics.of(1).iae, 0.0) << "each joint for itself";
}

TEST(ErrorMetrics, OfADecayingErrorAreThoseOfTheClosedForm) {
  ErrorMetrics metrics = make(1, 1ms);
  for (int k = 0; k <= 20'000; ++k) metrics.step(std::array{0.3 * std::exp(-0.002 * k)});
  const auto& figures = metrics.of(0);  // A/a, A/a^2, A^2/(2a), A^2/(4a^2) with A = 0.3, a = 2
  EXPECT_NEAR(figures.iae, 0.15, 1e-6);
  EXPECT_NEAR(figures.itae, 0.075, 1e-6);
  EXPECT_NEAR(figures.ise, 0.0225, 1e-6);
  EXPECT_NEAR(figures.itse, 0.005625, 1e-6);
  EXPECT_EQ(figures.largest, 0.3);
  EXPECT_NEAR(figures.last, 0.0, 1e-16);
}

TEST(ErrorMetrics, OfASineAreThoseOfTheClosedForm) {
  const double pi = std::acos(-1.0);
  ErrorMetrics metrics = make(1, 1ms);
  for (int k = 0; k <= 2000; ++k) metrics.step(std::array{std::sin(pi * 0.001 * k)});
  const auto& figures = metrics.of(0);  // over one period of 2 s
  EXPECT_NEAR(figures.iae, 4.0 / pi, 1e-5);
  EXPECT_NEAR(figures.itae, 4.0 / pi, 1e-5);
  EXPECT_NEAR(figures.ise, 1.0, 1e-5);
  EXPECT_NEAR(figures.itse, 1.0, 1e-5);
  EXPECT_NEAR(figures.largest, 1.0, 1e-12);
}

TEST(ErrorMetrics, OneSampleEnclosesNoArea) {
  ErrorMetrics metrics = make(1, 1ms);
  metrics.step(std::array{0.7});
  EXPECT_EQ(metrics.of(0).iae, 0.0);
  EXPECT_EQ(metrics.of(0).largest, 0.7);
  EXPECT_EQ(metrics.of(0).last, 0.7);
}

TEST(ErrorMetrics, ASampleThatIsNotFiniteIsCountedAndTheOneBeforeStandsForIt) {
  ErrorMetrics metrics = make(1, 100ms);
  ErrorMetrics twin = make(1, 100ms);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double error : {0.1, nan, -0.2, infinity}) metrics.step(std::array{error});
  for (const double error : {0.1, 0.1, -0.2, -0.2}) twin.step(std::array{error});
  EXPECT_EQ(metrics.of(0).not_finite, 2u);
  EXPECT_EQ(metrics.of(0).itae, twin.of(0).itae);
  EXPECT_EQ(metrics.of(0).ise, twin.of(0).ise);
  EXPECT_EQ(metrics.of(0).last, -0.2);
  EXPECT_EQ(metrics.of(0).largest, 0.2);
}

TEST(ErrorMetrics, AnotherNumberOfJointsIsRefused) {
  ErrorMetrics metrics = make(2, 1ms);
  EXPECT_FALSE(metrics.step(std::array{1.0}));
  EXPECT_FALSE(metrics.step(std::array{1.0, 1.0, 1.0}));
  EXPECT_EQ(metrics.samples(), 0u);
  EXPECT_EQ(metrics.of(0).largest, 0.0);
}

TEST(ErrorMetrics, AResetForgetsEverything) {
  ErrorMetrics metrics = make(1, 1ms);
  metrics.step(std::array{0.7});
  metrics.step(std::array{0.7});
  metrics.reset();
  EXPECT_EQ(metrics.samples(), 0u);
  metrics.step(std::array{0.1});
  EXPECT_EQ(metrics.of(0).iae, 0.0);
  EXPECT_EQ(metrics.of(0).largest, 0.1);
}

TEST(ErrorMetrics, ARefusedConfigurationNamesEveryFieldThatIsWrong) {
  EXPECT_EQ(ErrorMetrics::make({0, -1ms}).error(),
            "ErrorMetrics: joints is 0, expected at least 1; period [s] is -0.001, expected a "
            "finite number above 0");
}

TEST(ErrorMetrics, AreBoundByTheLargestErrorAndTheTime) {
  std::mt19937_64 random(4711);
  std::normal_distribution<double> errors(0.0, 0.01);
  ErrorMetrics metrics = make(1, 10ms);
  for (int k = 0; k <= 6000; ++k) {
    metrics.step(std::array{errors(random)});
    const auto& figures = metrics.of(0);
    const double time_s = 0.01 * k + 1e-12;
    ASSERT_LE(figures.iae, figures.largest * time_s);
    ASSERT_LE(figures.itae, figures.iae * time_s);
    ASSERT_LE(figures.ise, figures.iae * figures.largest + 1e-15);
    ASSERT_LE(figures.itse, figures.ise * time_s);
    ASSERT_LE(figures.iae * figures.iae, figures.ise * time_s + 1e-15) << "Cauchy and Schwarz";
  }
}

}  // namespace
}  // namespace armature::control
