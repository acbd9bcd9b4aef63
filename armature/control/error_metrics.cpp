// SPDX-License-Identifier: Apache-2.0
#include "armature/control/error_metrics.hpp"

#include <algorithm>
#include <cmath>

#include "armature/base/seconds.hpp"
#include "armature/control/internal/mistakes.hpp"

namespace armature::control {
base::Result<void> ErrorMetrics::check(const Config& config) {
  internal::Mistakes mistakes("ErrorMetrics");
  mistakes.expect(config.joints >= 1, "joints", 0.0, "at least 1");
  mistakes.expect_positive("period [s]", base::to_seconds(config.period));
  return mistakes.result();
}

base::Result<ErrorMetrics> ErrorMetrics::make(const Config& config) {
  if (const auto checked = check(config); !checked) return base::Error{checked.error()};
  return ErrorMetrics(config);
}

ErrorMetrics::ErrorMetrics(const Config& config)
    : period_s_(base::to_seconds(config.period)), figures_(config.joints) {}

bool ErrorMetrics::step(std::span<const double> errors) {
  if (errors.size() != figures_.size()) return false;
  const double time_s = static_cast<double>(samples_) * period_s_;
  for (std::size_t i = 0; i < errors.size(); ++i) add(figures_[i], errors[i], time_s);
  ++samples_;
  return true;
}

void ErrorMetrics::add(Figures& figures, double error, double time_s) const {
  const double before = figures.last;
  if (std::isfinite(error)) {
    figures.last = error;
  } else {
    ++figures.not_finite;
  }
  const double now = figures.last;
  figures.largest = std::max(figures.largest, std::abs(now));
  if (samples_ == 0) return;  // one sample encloses no area
  const double half = 0.5 * period_s_;
  const double time_before = time_s - period_s_;
  figures.iae += half * (std::abs(before) + std::abs(now));
  figures.itae += half * (time_before * std::abs(before) + time_s * std::abs(now));
  figures.ise += half * (before * before + now * now);
  figures.itse += half * (time_before * before * before + time_s * now * now);
}

void ErrorMetrics::reset() {
  std::fill(figures_.begin(), figures_.end(), Figures{});
  samples_ = 0;
}

}  // namespace armature::control
