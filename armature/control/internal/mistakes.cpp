// SPDX-License-Identifier: Apache-2.0
#include "armature/control/internal/mistakes.hpp"

#include <array>
#include <cmath>
#include <cstdio>

namespace armature::control::internal {
namespace {

std::string text_of(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.9g", value);
  return text.data();
}

}  // namespace

void Mistakes::expect(bool holds, std::string_view field, double value, std::string_view expected) {
  if (holds) return;
  if (!all_.empty()) all_ += "; ";
  all_.append(field).append(" is ").append(text_of(value)).append(", expected ").append(expected);
}

void Mistakes::expect_positive(std::string_view field, double value) {
  expect(std::isfinite(value) && value > 0.0, field, value, "a finite number above 0");
}

void Mistakes::expect_not_negative(std::string_view field, double value) {
  expect(std::isfinite(value) && value >= 0.0, field, value, "a finite number of at least 0");
}

void Mistakes::expect_finite(std::string_view field, double value) {
  expect(std::isfinite(value), field, value, "a finite number");
}

void Mistakes::expect_ends(const std::string& of, double lower, double upper) {
  expect(!std::isnan(lower), of + "lower", lower, "a number");
  expect(!std::isnan(upper), of + "upper", upper, "a number");
  expect(!(upper <= lower), of + "upper", upper, "a number above lower");
}

base::Result<void> Mistakes::result() const {
  if (all_.empty()) return {};
  return base::Error{object_ + ": " + all_};
}

}  // namespace armature::control::internal
