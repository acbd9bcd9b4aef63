// SPDX-License-Identifier: Apache-2.0
#include "armature/control/arming/hand_over.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace armature::control {
namespace {

/// 1 at 0, 0 from 1 on, smooth at both.
double left_of(double passed) {
  return passed >= 1.0 ? 0.0 : 1.0 - passed * passed * (3.0 - 2.0 * passed);
}

}  // namespace

HandOver::HandOver(std::size_t signals) {
  state_.present.assign(signals, 0.0);
  state_.offsets.assign(signals, 0.0);
  state_.noise.assign(signals, 0.0);
}

bool HandOver::begin(std::span<const double> present, double learning,
                     std::span<const double> lately) {
  reset();
  if (present.size() != state_.present.size()) return false;
  if (!lately.empty() && lately.size() != present.size()) return false;
  std::copy(present.begin(), present.end(), state_.present.begin());
  for (std::size_t i = 0; i < present.size(); ++i) {
    const double noise = lately.empty() ? 0.0 : present[i] - lately[i];
    state_.noise[i] = std::isfinite(noise) ? noise : 0.0;
  }
  state_.learning = learning;
  state_.samples = 0;
  state_.active = true;
  return true;
}

void HandOver::reset() { state_.active = false; }

void HandOver::step(std::span<double> signals, base::Time now, base::Duration time) {
  if (!state_.active) return;
  if (time <= base::Duration::zero()) return reset();
  if (state_.samples == 0) {
    begin_at(signals, now);
    for (std::size_t i = 0; i < signals.size(); ++i) {
      if (std::isfinite(state_.present[i])) signals[i] = state_.present[i];
    }
    return;
  }
  const double passed =
      static_cast<double>((now - state_.begun).count()) / static_cast<double>(time.count());
  if (passed >= 1.0) return reset();
  if (passed <= state_.learning) learn(signals);
  const double left = left_of(passed);
  const double noise_left = state_.learning > 0.0 ? left_of(passed / state_.learning) : 0.0;
  for (std::size_t i = 0; i < signals.size(); ++i) {
    signals[i] += left * state_.offsets[i] + noise_left * state_.noise[i];
  }
}

/// A signal that is no number stays one: whoever must stop the joint sees it.
void HandOver::begin_at(std::span<const double> signals, base::Time now) {
  state_.begun = now;
  state_.samples = 1;
  for (std::size_t i = 0; i < signals.size(); ++i) {
    const double offset = state_.present[i] - state_.noise[i] - signals[i];
    const bool finite = std::isfinite(offset);
    state_.offsets[i] = finite ? offset : 0.0;
    if (!finite) state_.present[i] = std::numeric_limits<double>::quiet_NaN();
  }
}

void HandOver::learn(std::span<const double> signals) {
  ++state_.samples;
  for (std::size_t i = 0; i < signals.size(); ++i) {
    const double offset = state_.present[i] - state_.noise[i] - signals[i];
    if (std::isfinite(offset)) state_.offsets[i] += (offset - state_.offsets[i]) / state_.samples;
  }
}

}  // namespace armature::control
