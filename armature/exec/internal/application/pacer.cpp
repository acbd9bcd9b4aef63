// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/internal/application/pacer.hpp"

#include <chrono>

namespace armature::exec::internal {
namespace {

constexpr base::Duration kMostMadeUpFor = std::chrono::milliseconds(100);

}  // namespace

void Pacer::set(double rate, base::Time simulated, base::Time now) {
  rate_ = rate;
  simulated_ = simulated;
  real_ = now;
}

void Pacer::resume(base::Time simulated, base::Time now) {
  paused_ = false;
  steps_ = 0;
  set(rate_, simulated, now);
}

base::Time Pacer::time_of(base::Time next) const {
  if (paused_) return steps_ > 0 ? base::Time::min() : base::Time::max();
  if (rate_ == kAsFastAsPossible) return base::Time::min();
  const std::chrono::duration<double, std::nano> wait = (next - simulated_) / rate_;
  const auto longest = static_cast<double>((base::Time::max() - real_).count());
  if (wait.count() >= longest) return base::Time::max();
  return real_ + std::chrono::duration_cast<base::Duration>(wait);
}

void Pacer::arrive(base::Time next, base::Time now) {
  if (paused_) {
    if (steps_ > 0) --steps_;
  } else if (rate_ != kAsFastAsPossible && now - time_of(next) > kMostMadeUpFor) {
    set(rate_, next, now);
  }
}

}  // namespace armature::exec::internal
