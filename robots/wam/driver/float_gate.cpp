// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/driver/float_gate.hpp"

#include <algorithm>
#include <cmath>

#include "robots/wam/internal/number_text.hpp"

namespace armature::wam {
namespace {

/// [s] at rest, over which the torques are taken.
constexpr double kFloatRestTime = 1.0;
/// [rad/s] Faster, a joint is not at rest; encoders of joints at rest show less.
constexpr double kFloatsBelow = 0.1;

}  // namespace

void FloatGate::begin() {
  open_ = true;
  forget();
}

void FloatGate::forget() {
  std::ranges::fill(sums_, 0.0);
  cycles_ = 0;
}

FloatGate::Verdict FloatGate::step(std::span<const double> velocities,
                                   std::span<const double> torques) {
  if (!open_) return Verdict::kNone;
  const auto rests = [](double velocity) { return std::abs(velocity) < kFloatsBelow; };
  if (!std::ranges::all_of(velocities, rests)) {
    forget();
    return Verdict::kNone;
  }
  for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i] += torques[i];
  if (++cycles_ * config_.period_s < kFloatRestTime) return Verdict::kNone;
  open_ = false;
  for (loaded_ = 0; loaded_ < sums_.size(); ++loaded_) {
    load_ = sums_[loaded_] / cycles_;
    const bool known = std::abs(load_) <= config_.max_load[loaded_];  // no number is not
    if (!known) return Verdict::kStays;
  }
  return Verdict::kMayFloat;
}

component::Reason FloatGate::why() const {
  component::Reason why("joint ");
  internal::append_number(why, static_cast<double>(loaded_ + 1)).append(" needs ");
  internal::append_number(why, load_)
      .append(" Nm beside the weight of its description, expected at most ");
  return internal::append_number(why, config_.max_load[loaded_]);
}

}  // namespace armature::wam
