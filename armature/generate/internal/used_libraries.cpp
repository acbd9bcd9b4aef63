// SPDX-License-Identifier: Apache-2.0
#include "armature/generate/internal/used_libraries.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>

#include "armature/component/library.hpp"
#include "armature/deploy/loader.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/platform/elf/shared_object.hpp"

namespace armature::generate::internal {
namespace {

/// `motion` of `/usr/lib/armature/libmotion.so`.
std::string name_of_file(const std::string& file) {
  const std::string stem = std::filesystem::path(file).stem().string();
  return stem.starts_with("lib") ? stem.substr(3) : stem;
}

/// As cmake/ArmatureComponentLibrary.cmake makes it.
std::string entry_of(const std::string& name) {
  std::string identifier = name;
  std::ranges::replace_if(
      identifier, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return std::string(component::kLibraryEntry) + '_' + identifier;
}

/// How the libraries call themselves that the components are from.
std::set<std::string> wanted_by(const deploy::Deployment& deployment) {
  std::set<std::string> names;
  for (const exec::ComponentEntry& entry : deployment.blueprint.components) {
    const auto* const model = deployment.models.find(entry.model);
    if (model != nullptr) names.insert(model->library);
  }
  return names;
}

}  // namespace

std::vector<UsedLibrary> used_libraries(const deploy::Deployment& deployment,
                                        const std::vector<std::string>& folders,
                                        base::Diagnostics& diagnostics) {
  std::set<std::string> wanted = wanted_by(deployment);
  std::vector<UsedLibrary> used;
  for (const document::Reference& library : deployment.document.libraries) {
    const auto file = deploy::find_library(library.name, folders);
    const auto loaded = platform::SharedObject::load(file ? file.value() : library.name);
    if (!file || !loaded) continue;  // which the check has told
    const auto describe =
        reinterpret_cast<component::LibraryEntry>(loaded.value().symbol(component::kLibraryEntry));
    if (describe == nullptr || wanted.erase(describe()->name) == 0) continue;
    const std::string name = name_of_file(file.value());
    const std::string entry = entry_of(name);
    if (loaded.value().symbol(entry.c_str()) == nullptr) {
      diagnostics.error(library.where,
                        "component library " + document::in_quotes(library.name) +
                            " cannot be linked: it does not export " + entry,
                        "rebuild it with armature_component_library() of this Armature");
      continue;
    }
    used.push_back({name, entry});
  }
  return used;
}

}  // namespace armature::generate::internal
