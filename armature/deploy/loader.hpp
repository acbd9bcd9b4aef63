// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/base/result.hpp"
#include "armature/component/registry.hpp"
#include "armature/document/document.hpp"

namespace armature::deploy {

/// Where component libraries are looked for, in this order: `first`, the folders of the environment
/// variable ARMATURE_LIBRARY_PATH (separated by colons), lib/armature beside the program's own
/// folder, and the folder of the deployment `document_file`.
std::vector<std::string> library_folders(const std::vector<std::string>& first,
                                         const std::string& document_file);

/// The names of all component libraries in `folders`, sorted.
std::vector<std::string> available_libraries(const std::vector<std::string>& folders);

/// The file of the library `motion`: libmotion.so in the first of `folders` that has it. A name
/// with a slash is the file itself, relative to the last folder. The error lists where it was
/// looked for, and the nearest name.
base::Result<std::string> find_library(std::string_view name,
                                       const std::vector<std::string>& folders);

/// Loads a component library and adds its models to `registry`. Refuses what is no library, has no
/// `armature_component_library`, was built for another ABI or with headers of another layout, or
/// brings a model that exists already. What the library needs of Armature is that of this program,
/// whichever installation it was built against. The library stays loaded until the program ends.
base::Result<void> load_library(const std::string& file, component::Registry& registry);

/// Finds and loads libraries; each that fails is reported at its place. One that is named twice is
/// loaded once.
/// @return false if any failed
bool load_libraries(const std::vector<document::Reference>& libraries,
                    const std::vector<std::string>& folders, component::Registry& registry,
                    base::Diagnostics& diagnostics);

}  // namespace armature::deploy
