// SPDX-License-Identifier: Apache-2.0
#include "armature/rt/statistics.hpp"

#include <algorithm>
#include <cmath>

namespace armature::rt {

std::uint64_t DistributionSummary::percentile(double share) const {
  const auto wanted = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(count)));
  std::uint64_t seen = 0;
  for (std::size_t i = 0; i < buckets.size(); ++i) {
    seen += buckets[i];
    if (seen >= wanted && seen > 0) return std::min(Distribution::upper_bound_of(i), most);
  }
  return most;
}

DistributionSummary Distribution::summary() const {
  DistributionSummary result;
  for (std::size_t i = 0; i < buckets_.size(); ++i) {
    result.buckets[i] = buckets_[i].load(std::memory_order_acquire);
    result.count += result.buckets[i];
  }
  result.total = total_.load(std::memory_order_relaxed);
  result.most = most_.load(std::memory_order_relaxed);
  result.least = result.count == 0 ? 0 : least_.load(std::memory_order_relaxed);
  return result;
}

}  // namespace armature::rt
