// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/base/diagnostic.hpp"
#include "idl/model.hpp"

namespace armature::idl {

/// Finds what the grammar allows and no program can mean: names that are unknown or used twice,
/// structs that contain themselves, ranges that a type cannot hold, two operations with one number,
/// and what is beyond limits.hpp.
void check(const Program& program, base::Diagnostics& diagnostics);

}  // namespace armature::idl
