// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "idl/cpp_names.hpp"
#include "idl/model.hpp"
#include "idl/output.hpp"

namespace armature::idl {

/// `NAME.json`: all that the main module says, and the structs it uses of others, for tools.
/// docs/idl.md has its shape.
OutputFile write_json(const Program& program, const CppNames& names);

}  // namespace armature::idl
