// SPDX-License-Identifier: Apache-2.0
#include "armature/rt/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace armature::rt {
namespace {

constexpr std::uint64_t kLargest = std::numeric_limits<std::uint64_t>::max();

TEST(DistributionBuckets, EveryValueLiesInTheBucketThatEndsAtOrAboveIt) {
  std::vector<std::uint64_t> values{0, kLargest};
  for (int exponent = 0; exponent < 64; ++exponent) {
    const std::uint64_t power = std::uint64_t{1} << exponent;
    for (const std::uint64_t value :
         {power - 1, power, power + 1, power + power / 4, power + power / 2, power + (power - 1)}) {
      values.push_back(value);
    }
  }
  for (const std::uint64_t value : values) {
    const std::size_t bucket = Distribution::bucket_of(value);
    ASSERT_LT(bucket, DistributionSummary{}.buckets.size()) << value;
    EXPECT_LE(value, Distribution::upper_bound_of(bucket)) << value;
    if (bucket > 0) {
      EXPECT_GT(value, Distribution::upper_bound_of(bucket - 1)) << value;
    }
  }
  EXPECT_EQ(Distribution::upper_bound_of(Distribution::bucket_of(kLargest)), kLargest);
}

TEST(DistributionBuckets, ABucketIsAtMostAQuarterWide) {
  for (std::size_t bucket = 1; bucket <= Distribution::bucket_of(kLargest); ++bucket) {
    const std::uint64_t first = Distribution::upper_bound_of(bucket - 1) + 1;
    EXPECT_LE(Distribution::upper_bound_of(bucket) - first, first / 4) << bucket;
  }
}

TEST(Distribution, ExtremesTotalAndMeanAreExact) {
  Distribution distribution;
  for (const std::uint64_t value : {1000003u, 17u, 999983u}) distribution.add(value);
  const DistributionSummary summary = distribution.summary();
  EXPECT_EQ(summary.count, 3u);
  EXPECT_EQ(summary.total, 2000003u);
  EXPECT_EQ(summary.least, 17u);
  EXPECT_EQ(summary.most, 1000003u);
  EXPECT_DOUBLE_EQ(summary.mean(), 2000003.0 / 3.0);
  EXPECT_EQ(summary.percentile(1.0), 1000003u);
}

TEST(Distribution, IsZeroBeforeTheFirstValue) {
  const DistributionSummary summary = Distribution().summary();
  EXPECT_EQ(summary.count, 0u);
  EXPECT_EQ(summary.least, 0u);
  EXPECT_EQ(summary.most, 0u);
  EXPECT_EQ(summary.mean(), 0.0);
  EXPECT_EQ(summary.percentile(0.5), 0u);
}

TEST(Distribution, OneValueIsItsOwnPercentiles) {
  Distribution distribution;
  distribution.add(12345);
  for (const double share : {0.0, 0.001, 0.5, 0.99, 1.0}) {
    EXPECT_EQ(distribution.summary().percentile(share), 12345u) << share;
  }
}

TEST(Distribution, SmallValuesAreToldApart) {
  Distribution distribution;
  for (std::uint64_t value = 0; value < 8; ++value) distribution.add(value);
  const DistributionSummary summary = distribution.summary();
  for (std::uint64_t value = 0; value < 8; ++value) {
    EXPECT_EQ(summary.percentile((static_cast<double>(value) + 1) / 8), value);
  }
}

TEST(Distribution, PercentilesAreAtMostAQuarterTooLarge) {
  std::mt19937_64 random(1);
  std::lognormal_distribution<double> latency(9.0, 2.0);
  Distribution distribution;
  std::vector<std::uint64_t> values;
  for (int i = 0; i < 10000; ++i) {
    values.push_back(static_cast<std::uint64_t>(latency(random)));
    distribution.add(values.back());
  }
  std::sort(values.begin(), values.end());
  const DistributionSummary summary = distribution.summary();
  for (const double share : {0.001, 0.1, 0.5, 0.9, 0.99, 0.999}) {
    const auto rank = static_cast<std::size_t>(std::ceil(share * 10000)) - 1;
    EXPECT_GE(summary.percentile(share), values[rank]) << share;
    EXPECT_LE(summary.percentile(share), values[rank] + values[rank] / 4) << share;
  }
}

}  // namespace
}  // namespace armature::rt
