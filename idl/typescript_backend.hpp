// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "idl/model.hpp"
#include "idl/output.hpp"

namespace armature::idl {

/// `NAME.ts`: types and placeholders of the main module for pages and Node.js, on the runtime in
/// web/ride. What it uses of other modules it imports from theirs. The same program gives the same
/// text. `program` has no mistake.
OutputFile write_typescript(const Program& program);
/// `NAME_service.ts`: frames of components for those who implement them.
OutputFile write_typescript_services(const Program& program);

}  // namespace armature::idl
