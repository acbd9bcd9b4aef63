// SPDX-License-Identifier: Apache-2.0
#include "armature/bundle/internal/installation.hpp"

#include <array>
#include <filesystem>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "armature/deploy/loader.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/platform/elf/linked_file.hpp"

namespace armature::bundle::internal {
namespace {

namespace fs = std::filesystem;
using document::path_in_quotes;

using namespace std::string_literals;

constexpr std::string_view kProgram = "bin/armature";
constexpr std::string_view kGuardian = "bin/armature-guardian";
constexpr std::string_view kOrigin = "$ORIGIN";

bool is_installed(const std::string& file) {
  std::error_code ignored;
  return fs::exists(file, ignored);
}

bool is_of_armature(std::string_view library) { return library.starts_with("libarmature_"); }

/// Follows what files need, each once.
class Search {
 public:
  Search(const std::string& folder, const Architecture& architecture,
         base::Diagnostics& diagnostics)
      : folder_(folder), architecture_(architecture), diagnostics_(diagnostics) {}

  /// A program or a library of Armature, by its place in the installation.
  void add_own(const std::string& place) {
    const std::string file = folder_ + "/" + place;
    if (!found_.own.emplace(place, file).second) return;
    const auto linked = read(file, {});
    if (!linked) return;
    for (const std::string& folder : linked->folders) {
      if (!folder.starts_with(kOrigin)) return refuse_build_tree(file, folder);
      add_library_folder(place, folder.substr(kOrigin.size()));
    }
    add_needs(*linked, file);
  }

  void add_component(const document::Reference& library, const std::string& file) {
    found_.own.emplace("lib/armature/lib" + library.name + ".so", file);
    if (const auto linked = read(file, library.where)) add_needs(*linked, file);
  }

  /// One that comes with the deployment.
  void add_other(const std::string& file) {
    if (const auto linked = read(file, {})) add_needs(*linked, file);
  }

  ProgramFiles take() { return std::move(found_); }

 private:
  std::optional<platform::LinkedFile> read(const std::string& file, const base::Location& where) {
    auto linked = platform::read_linked_file(file);
    if (!linked) {
      diagnostics_.error(where, linked.error());
      return std::nullopt;
    }
    if (architecture_of(linked.value()) == &architecture_) return std::move(linked).value();
    diagnostics_.error(where,
                       path_in_quotes(file) + " is for " + machine_name(linked.value()) +
                           ", expected one for " + std::string(architecture_.name),
                       "name a folder with an Armature that was built for " +
                           std::string(architecture_.name) + " by --installation");
    return std::nullopt;
  }

  void refuse_build_tree(const std::string& file, const std::string& folder) {
    if (std::exchange(refused_, true)) return;
    diagnostics_.error({},
                       path_in_quotes(file) + " looks for its libraries in " +
                           path_in_quotes(folder) +
                           ", as in a build tree; expected an installation, which finds them "
                           "beside itself",
                       "cmake --install BUILD --prefix FOLDER, then --installation FOLDER");
  }

  /// @param from  the place of a file that looks for libraries in the folder `way`, from its own
  void add_library_folder(const std::string& from, const std::string& way) {
    const fs::path folder = fs::path(from).parent_path() / fs::path(way).relative_path();
    library_folders_.insert(folder.lexically_normal().string());
  }

  void add_needs(const platform::LinkedFile& linked, const std::string& file) {
    for (const std::string& library : linked.needed) {
      if (is_of_armature(library)) {
        add_library(library, file);
      } else {
        found_.system.emplace(library, system_file("", library, architecture_));
      }
    }
  }

  void add_library(const std::string& library, const std::string& needed_by) {
    for (const std::string& folder : library_folders_) {
      const std::string place = (fs::path(folder) / library).string();
      if (is_installed(folder_ + "/" + place)) return add_own(place);
    }
    if (refused_) return;
    diagnostics_.error({},
                       path_in_quotes(needed_by) + " needs " + library +
                           ", which is not in the installation " + path_in_quotes(folder_),
                       "build both of the same version");
  }

  const std::string& folder_;
  const Architecture& architecture_;
  base::Diagnostics& diagnostics_;
  std::set<std::string> library_folders_;  ///< places in the installation
  ProgramFiles found_;
  bool refused_ = false;
};

}  // namespace

std::string system_file(const std::string& root, const std::string& library,
                        const Architecture& architecture) {
  for (const std::string& folder : {"/lib/" + std::string(architecture.folder),
                                    "/usr/lib/" + std::string(architecture.folder), "/lib"s}) {
    if (std::string file = root + folder + "/" + library; is_installed(file)) return file;
  }
  return {};
}

ProgramFiles Installation::files(const std::vector<document::Reference>& components,
                                 const std::vector<std::string>& folders,
                                 const std::vector<std::string>& others,
                                 base::Diagnostics& diagnostics) const {
  Search search(folder_, architecture_, diagnostics);
  search.add_own(std::string(kProgram));
  search.add_own(std::string(kGuardian));
  if (!diagnostics.ok()) return {};
  for (const document::Reference& library : components) {
    const auto file = deploy::find_library(library.name, folders);
    if (file) search.add_component(library, file.value());
    if (!file) diagnostics.error(library.where, file.error());
  }
  for (const std::string& file : others) search.add_other(file);
  return search.take();
}

}  // namespace armature::bundle::internal
