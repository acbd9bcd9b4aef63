// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/base/result.hpp"
#include "armature/component/registry.hpp"

namespace armature::component {

/// What `kLibraryEntry` of a library is.
using LibraryEntry = const LibraryDescription* (*)();

/// Adds the models of a component library that is in memory.
/// @param description  as its entry returns it; may be null
/// @param library      begins messages: its file in quotes
/// @return the error: it was built for another runtime, with other headers or has no description;
/// it
///         threw; one of its models exists already
/// @thread configuration only
base::Result<void> add_library(const LibraryDescription* description, const std::string& library,
                               Registry& registry);

}  // namespace armature::component
