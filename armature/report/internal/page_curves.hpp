// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "armature/report/internal/json.hpp"
#include "armature/report/signals.hpp"

namespace armature::report::internal {

/// A curve with at most about `points` points, as page/curves.js unpacks it: whole numbers, each as
/// the difference to the one before, of 1/`per` of the signal's unit and of 0.1 ms. What is no
/// number is null.
Json packed(const Signal& signal, std::size_t points, double per);

/// The same with five digits of the largest value.
Json packed(const Signal& signal, std::size_t points);

}  // namespace armature::report::internal
