// SPDX-License-Identifier: Apache-2.0
#include "armature/report/internal/page_curves.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace armature::report::internal {
namespace {

constexpr double kTicksPerSecond = 1e4;
constexpr double kMostDigits = 9e15;  // a double counts so far in whole numbers, and JavaScript too

Json differences(const std::vector<double>& values, double per) {
  Json all = Json::array();
  std::int64_t before = 0;
  for (const double value : values) {
    const double scaled = std::round(value * per);
    if (!std::isfinite(scaled)) {
      all.push_back(nullptr);
      continue;
    }
    const auto whole = static_cast<std::int64_t>(std::clamp(scaled, -kMostDigits, kMostDigits));
    all.push_back(whole - before);
    before = whole;
  }
  return all;
}

double per_for(const std::vector<double>& values) {
  double largest = 0.0;
  for (const double value : values) {
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  }
  return largest > 0.0 ? std::pow(10.0, 5.0 - std::ceil(std::log10(largest))) : 1.0;
}

}  // namespace

Json packed(const Signal& signal, std::size_t points, double per) {
  const Signal thin = thinned(signal, points);
  return {{"t", differences(thin.time_s, kTicksPerSecond)},
          {"v", differences(thin.values, per)},
          {"per", per}};
}

Json packed(const Signal& signal, std::size_t points) {
  return packed(signal, points, per_for(signal.values));
}

}  // namespace armature::report::internal
