// SPDX-License-Identifier: Apache-2.0
#include "armature/control/hand_over.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace armature::control {

HandOver::HandOver(std::size_t signals) { state_.offsets.assign(signals, 0.0); }

bool HandOver::begin(std::span<const double> present) {
  reset();
  if (present.size() != state_.offsets.size()) return false;
  std::copy(present.begin(), present.end(), state_.offsets.begin());
  state_.pending = true;
  state_.active = true;
  return true;
}

void HandOver::reset() {
  state_.pending = false;
  state_.active = false;
}

void HandOver::step(std::span<double> signals, base::Time now, base::Duration time) {
  if (!state_.active) return;
  if (time <= base::Duration::zero()) return reset();
  if (std::exchange(state_.pending, false)) {
    state_.begun = now;
    for (std::size_t i = 0; i < signals.size(); ++i) {
      const double present = state_.offsets[i];
      const double offset = present - signals[i];
      // A signal that is no number stays one: whoever must stop the joint sees it.
      state_.offsets[i] = std::isfinite(offset) ? offset : 0.0;
      if (std::isfinite(offset)) signals[i] = present;
    }
    return;
  }
  const double passed =
      static_cast<double>((now - state_.begun).count()) / static_cast<double>(time.count());
  if (passed >= 1.0) return reset();
  const double left = 1.0 - passed * passed * (3.0 - 2.0 * passed);
  for (std::size_t i = 0; i < signals.size(); ++i) signals[i] += left * state_.offsets[i];
}

}  // namespace armature::control
