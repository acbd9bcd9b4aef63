// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "idl/model.hpp"

namespace armature::idl::internal {

/// The structs and events of the main module: what one contains stands before it; otherwise as in
/// the file.
std::vector<const Structure*> in_order_of_use(const Program& program);

}  // namespace armature::idl::internal
