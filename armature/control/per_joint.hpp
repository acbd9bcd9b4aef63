// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "armature/base/result.hpp"

namespace armature::control {

/// The numbers of `joints` joints, from one for each or one for all.
/// @param name  of the parameter, for the error, which says how many were expected and found
base::Result<std::vector<double>> per_joint(std::string_view name,
                                            const std::vector<double>& numbers, std::size_t joints);

}  // namespace armature::control
