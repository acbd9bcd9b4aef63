// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "armature/foxglove/internal/shape.hpp"

namespace armature::foxglove::internal {

/// The JSON of a value whose numbers come one after the other: the text between them stays the same
/// while the value is watched.
class NumberText {
 public:
  /// @param shape  of the whole value
  /// @param paths  of its numbers, as watches have them: empty, `[2]`, `.gains.kp`
  NumberText(const Shape& shape, const std::vector<std::string>& paths);

  /// @param numbers  as many as paths; NaN becomes null
  std::string filled(std::span<const double> numbers) const;

 private:
  std::vector<std::string> pieces_;  ///< around the numbers: one more than these
  std::vector<bool> is_bool_;        ///< of each number
};

}  // namespace armature::foxglove::internal
