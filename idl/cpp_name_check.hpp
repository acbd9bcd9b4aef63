// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/base/diagnostic.hpp"
#include "idl/cpp_names.hpp"
#include "idl/model.hpp"

namespace armature::idl {

/// Finds names that C++ cannot have, or not beside each other.
void check_cpp_names(const Program& program, const CppNames& names, base::Diagnostics& diagnostics);

}  // namespace armature::idl
