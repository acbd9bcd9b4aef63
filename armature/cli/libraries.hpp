// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/component/registry.hpp"
#include "armature/deploy/loader.hpp"

namespace armature::cli {

/// The models of component libraries, and what went wrong with loading them.
struct LoadedModels {
  component::Registry models;
  base::Diagnostics diagnostics;
};

/// Of `libraries`, or of all that are in the folders if none is named.
inline LoadedModels models_of(std::vector<std::string> libraries,
                              const std::vector<std::string>& library_folders) {
  LoadedModels loaded;
  const std::vector<std::string> folders = deploy::library_folders(library_folders, "./");
  if (libraries.empty()) libraries = deploy::available_libraries(folders);
  std::vector<document::Reference> references;
  for (const std::string& name : libraries) references.push_back({name, {}});
  deploy::load_libraries(references, folders, loaded.models, loaded.diagnostics);
  return loaded;
}

}  // namespace armature::cli
