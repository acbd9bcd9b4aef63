// SPDX-License-Identifier: Apache-2.0
#include "armature/base/time.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

namespace armature::base {

std::string to_text(Duration duration) {
  constexpr std::array<std::pair<std::int64_t, const char*>, 4> kUnits = {
      {{1'000'000'000, " s"}, {1'000'000, " ms"}, {1'000, " us"}, {1, " ns"}}};
  const std::int64_t ns = duration.count();
  const auto unit = std::find_if(kUnits.begin(), kUnits.end(),
                                 [&](const auto& one) { return ns % one.first == 0; });
  return std::to_string(ns / unit->first) + unit->second;
}

}  // namespace armature::base
