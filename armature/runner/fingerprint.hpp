// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "armature/exec/application_options.hpp"
#include "armature/exec/blueprint.hpp"

namespace armature::runner {

/// All that a blueprint and its options say of an application, as text, a line for each thing:
/// components with the values of all their properties, activities, peers, bindings, commands that
/// events give, connections, modes, reactions to faults, commands before the stop. Of a property
/// that names a file by an absolute path there is the file's content in place of its path. Grants
/// are left out: they are for tools.
std::string outline(const exec::Blueprint& blueprint, const exec::ApplicationOptions& options);

/// 64-bit FNV-1a of the outline: equal if nothing of what was checked has changed.
std::uint64_t fingerprint(const exec::Blueprint& blueprint,
                          const exec::ApplicationOptions& options);

}  // namespace armature::runner
