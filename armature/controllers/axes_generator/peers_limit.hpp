// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/control/motion_limit.hpp"

namespace armature::controllers {

/// What a peer says of a motion by its operation `motionLimitUsed`.
class PeersLimit final : public control::MotionLimit {
 public:
  using Vector = std::vector<double>;
  using Caller = component::OperationCaller<double(const Vector&, const Vector&)>;

  /// @param share  of what the peer allows that motions are to use, 0..1
  explicit PeersLimit(Caller& caller, double share = 1.0) : caller_(caller), share_(share) {}
  void resize(std::size_t axes) {
    positions_.assign(axes, 0.0);
    velocities_.assign(axes, 0.0);
  }

  /// @return itself, or nullptr where no peer limits motions
  control::MotionLimit* where_bound() { return caller_.bound() ? this : nullptr; }

  /// A peer that does not answer allows nothing.
  double used(std::span<const double> positions, std::span<const double> velocities) override {
    std::ranges::copy(positions, positions_.begin());
    std::ranges::copy(velocities, velocities_.begin());
    const auto answer = caller_(positions_, velocities_);
    const bool usable = answer && std::isfinite(answer.value);
    return usable ? answer.value / share_ : std::numeric_limits<double>::infinity();
  }

 private:
  Caller& caller_;
  double share_;
  Vector positions_;
  Vector velocities_;
};

}  // namespace armature::controllers
