// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "idl/cpp_names.hpp"
#include "idl/model.hpp"
#include "idl/output.hpp"

namespace armature::idl {

/// The C++ of the main module: `NAME_types.hpp`, `NAME_client.hpp/.cpp`, `NAME_service.hpp/.cpp`.
/// The same program gives the same text. `program` has no mistake, of C++ names neither.
std::vector<OutputFile> write_cpp(const Program& program, const CppNames& names);

}  // namespace armature::idl
