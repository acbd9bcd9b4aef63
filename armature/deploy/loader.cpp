// SPDX-License-Identifier: Apache-2.0
#include "armature/deploy/loader.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <string_view>
#include <system_error>

#include "armature/base/joined.hpp"
#include "armature/base/near_name.hpp"
#include "armature/component/library.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/platform/elf/shared_object.hpp"

namespace armature::deploy {

using namespace document;
namespace {

namespace fs = std::filesystem;

constexpr const char* kPathVariable = "ARMATURE_LIBRARY_PATH";
constexpr std::string_view kPrefix = "lib";
constexpr std::string_view kSuffix = ".so";

void add_variable(std::vector<std::string>& folders) {
  const char* variable = std::getenv(kPathVariable);
  std::string_view rest = variable != nullptr ? variable : "";
  while (!rest.empty()) {
    const std::size_t colon = rest.find(':');
    if (colon != 0) folders.emplace_back(rest.substr(0, colon));
    rest.remove_prefix(colon == std::string_view::npos ? rest.size() : colon + 1);
  }
}

/// The same in a build tree and in an installation: bin/armature and lib/armature/libmotion.so.
void add_beside_program(std::vector<std::string>& folders) {
  std::error_code failure;
  const fs::path program = fs::read_symlink("/proc/self/exe", failure);
  if (failure) return;
  folders.push_back((program.parent_path().parent_path() / "lib" / "armature").string());
}

std::string file_name(std::string_view library) {
  return std::string(kPrefix) + std::string(library) + std::string(kSuffix);
}

bool is_there(const std::string& file) {
  std::error_code ignored;
  return fs::exists(file, ignored);
}

/// A library of the runtime that this program runs on.
std::string in_own_runtime(std::string_view name) {
  const auto* const runtime = reinterpret_cast<const void*>(&component::abi_tag);
  return fs::path(platform::file_beside(runtime, name)).lexically_normal().string();
}

base::Error built_for_another_runtime(const std::string& file, const std::string& needed) {
  const fs::path own = platform::file_of(reinterpret_cast<const void*>(&component::abi_tag));
  return base::Error{path_in_quotes(file) + " was built for " + needed + ", but this program has " +
                     own.filename().string() + " in " +
                     path_in_quotes(fs::path(in_own_runtime("")).parent_path().string()) +
                     ": rebuild the library with this program's headers and compiler"};
}

/// A component library says in which folder its linker found Armature. That may be another
/// installation, or gone: what the library needs of Armature is taken from beside the runtime that
/// runs already, and then the system's loader looks for it nowhere else.
base::Result<void> load_runtime_for(const std::string& file) {
  for (const std::string& needed : platform::needed_libraries(file)) {
    if (!needed.starts_with("libarmature_")) continue;
    const std::string own = in_own_runtime(needed);
    if (is_there(own)) {
      const base::Result<platform::SharedObject> loaded = platform::SharedObject::load(own);
      if (!loaded) return base::Error{"cannot load " + path_in_quotes(own) + ": " + loaded.error()};
    } else if (needed.starts_with("libarmature_component.so")) {
      return built_for_another_runtime(file, needed);
    }
  }
  return {};
}

/// What the system's loader said, and what to do if Armature is what it did not find.
base::Error not_loaded(const std::string& reason) {
  constexpr std::string_view kMangledNamespace = "8armature";
  const std::size_t missing = reason.find("undefined symbol: ");
  const bool ours =
      missing != std::string::npos && reason.find(kMangledNamespace, missing) != std::string::npos;
  return base::Error{"cannot load the library: " + reason +
                     (ours ? "; this program's Armature does not have it: rebuild the library with "
                             "the headers of this program"
                           : "")};
}

/// The description that a library exports, if it is one.
base::Result<const component::LibraryDescription*> describe(const std::string& file) {
  if (auto runtime = load_runtime_for(file); !runtime) return base::Error{runtime.error()};
  const base::Result<platform::SharedObject> loaded = platform::SharedObject::load(file);
  if (!loaded) return not_loaded(loaded.error());
  const auto entry =
      reinterpret_cast<component::LibraryEntry>(loaded.value().symbol(component::kLibraryEntry));
  if (entry != nullptr) return entry();
  return base::Error{path_in_quotes(file) + " is not a component library: it does not export " +
                     component::kLibraryEntry +
                     "; write ARMATURE_COMPONENT_LIBRARY in one of its sources"};
}

}  // namespace

std::vector<std::string> available_libraries(const std::vector<std::string>& folders) {
  std::set<std::string> names;
  for (const std::string& folder : folders) {
    std::error_code failure;
    for (fs::directory_iterator each(folder, failure), end; !failure && each != end;
         each.increment(failure)) {
      const std::string name = each->path().filename().string();
      const bool fits = name.size() > kPrefix.size() + kSuffix.size() &&
                        name.starts_with(kPrefix) && name.ends_with(kSuffix);
      if (!fits) continue;
      names.insert(name.substr(kPrefix.size(), name.size() - kPrefix.size() - kSuffix.size()));
    }
  }
  return {names.begin(), names.end()};
}

std::vector<std::string> library_folders(const std::vector<std::string>& first,
                                         const std::string& document_file) {
  std::vector<std::string> folders = first;
  add_variable(folders);
  add_beside_program(folders);
  const std::string folder = fs::path(document_file).parent_path().string();
  folders.push_back(folder.empty() ? "." : folder);
  return folders;
}

base::Result<std::string> find_library(std::string_view name,
                                       const std::vector<std::string>& folders) {
  const std::string what = "component library " + in_quotes(name);
  if (name.find('/') != std::string_view::npos) {
    const fs::path folder = folders.empty() ? "." : folders.back();
    const std::string file = (folder / fs::path(name).lexically_normal()).string();
    if (is_there(file)) return file;
    return base::Error{what + " was not found: no " + path_in_quotes(file)};
  }
  for (const std::string& folder : folders) {
    const std::string file = (fs::path(folder) / file_name(name)).string();
    if (is_there(file)) return file;
  }
  std::string text =
      what + " was not found: no " + file_name(name) + " in " + base::joined(folders);
  const std::string near = base::near_name(name, available_libraries(folders));
  text += near.empty() ? "; build it, or name its folder with -L or " + std::string(kPathVariable)
                       : "; did you mean " + in_quotes(near) + "?";
  return base::Error{text};
}

base::Result<void> load_library(const std::string& file, component::Registry& registry) {
  const base::Result<const component::LibraryDescription*> description = describe(file);
  if (!description) return base::Error{description.error()};
  return component::add_library(description.value(), path_in_quotes(file), registry);
}

bool load_libraries(const std::vector<Reference>& libraries,
                    const std::vector<std::string>& folders, component::Registry& registry,
                    base::Diagnostics& diagnostics) {
  std::set<std::string> loaded;
  bool all = true;
  for (const Reference& library : libraries) {
    const base::Result<std::string> file = find_library(library.name, folders);
    if (!file) {
      diagnostics.error(library.where, file.error());
      all = false;
      continue;
    }
    std::error_code ignored;
    const std::string same = fs::weakly_canonical(file.value(), ignored).string();
    if (!loaded.insert(same).second) continue;
    const base::Result<void> result = load_library(file.value(), registry);
    if (!result) diagnostics.error(library.where, result.error());
    all &= result.ok();
  }
  return all;
}

}  // namespace armature::deploy
