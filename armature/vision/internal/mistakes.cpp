// SPDX-License-Identifier: Apache-2.0
#include "armature/vision/internal/mistakes.hpp"

#include <array>
#include <cstdio>

namespace armature::vision::internal {

void Mistakes::expect(bool holds, std::string_view field, double value, std::string_view expected) {
  if (holds) return;
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.9g", value);
  if (!all_.empty()) all_ += "; ";
  all_.append(field).append(" is ").append(text.data()).append(", expected ").append(expected);
}

void Mistakes::expect_share(std::string_view field, double value) {
  expect(value > 0.0 && value <= 1.0, field, value, "above 0, at most 1");
}

void Mistakes::expect_positive(std::string_view field, double value) {
  expect(value > 0.0, field, value, "above 0");
}

base::Result<void> Mistakes::result() const {
  if (all_.empty()) return {};
  return base::Error{object_ + ": " + all_};
}

}  // namespace armature::vision::internal
