// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <string>

#include "armature/base/time.hpp"

namespace armature::record::internal {

/// Exact, and the same length for all up to 31 years.
inline std::string seconds_text(base::Time time) {
  constexpr std::int64_t kNsPerSecond = 1'000'000'000;
  const std::int64_t ns = base::to_ns(time);
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%lld.%09lld", static_cast<long long>(ns / kNsPerSecond),
                static_cast<long long>(ns % kNsPerSecond));
  return text.data();
}

}  // namespace armature::record::internal
