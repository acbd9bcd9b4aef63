// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

namespace armature::cli {

/// The description (URDF) of an arm of one meter that stands on its base, stretched upwards, with
/// joints along and across its links by turns: something to begin with.
/// @param joints  1 to 7
std::string serial_arm(const std::string& name, std::size_t joints);

}  // namespace armature::cli
