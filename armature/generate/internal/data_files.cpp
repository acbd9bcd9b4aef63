// SPDX-License-Identifier: Apache-2.0
#include "armature/generate/internal/data_files.hpp"

#include <filesystem>
#include <set>
#include <string_view>

#include "armature/component/interface.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/platform/file.hpp"

namespace armature::generate::internal {
namespace {

namespace fs = std::filesystem;

std::string text_of(const component::PropertyBase& property) {
  if (property.type().kind != types::Kind::kText) return {};
  return types::to_text(property.type(), property.data());
}

/// Folders of the files that the deployment is written in; `${here}` is one of them.
std::set<std::string> folders_of(const document::Document& document) {
  std::set<std::string> folders;
  const auto add = [&](const base::Location& where) {
    const std::string folder = fs::path(where.file).parent_path().string();
    if (folder.size() > 1 && folder.starts_with('/')) folders.insert(folder + '/');
  };
  add({document.file, 0, 0});
  for (const document::Component& component : document.components) {
    add(component.where);
    for (const document::Property& property : component.properties) add(property.value.where);
  }
  for (const document::Property& parameter : document.parameters) add(parameter.value.where);
  return folders;
}

/// What somewhere inside a value counts from one of the folders.
bool mentions(const std::string& text, const std::set<std::string>& folders) {
  for (const std::string& folder : folders) {
    if (text.find(folder) != std::string::npos) return true;
  }
  return false;
}

/// `janus.urdf`; with a number if another file is called so.
std::string free_name(const std::string& path, const std::set<std::string>& taken) {
  const fs::path name = fs::path(path).filename();
  std::string free = name.string();
  for (int number = 2; taken.contains(free); ++number) {
    free = name.stem().string() + '_' + std::to_string(number) + name.extension().string();
  }
  return free;
}

}  // namespace

const std::string* DataFiles::name_of(const component::PropertyBase& property) const {
  const auto found = names.find(text_of(property));
  return found == names.end() ? nullptr : &found->second;
}

DataFiles find_data_files(const deploy::Deployment& deployment, base::Diagnostics& diagnostics) {
  DataFiles files;
  std::set<std::string> taken;
  const std::set<std::string> folders = folders_of(deployment.document);
  for (const exec::ComponentEntry& entry : deployment.blueprint.components) {
    for (const auto* property : component::interface_of(*entry.component).properties) {
      if (!property->was_set()) continue;
      const std::string path = text_of(*property);
      if (path.starts_with('/') && platform::expect_file(path).ok()) {
        if (files.names.contains(path)) continue;
        taken.insert(files.names.emplace(path, free_name(path, taken)).first->second);
        continue;
      }
      if (!mentions(types::to_text(property->type(), property->data()), folders)) continue;
      diagnostics.error(
          entry.where,
          document::in_quotes(entry.component->name() + "." + std::string(property->name())) +
              " names a place beside the deployment, which a generated program does not have",
          "name a file that is there, or one that counts from where the program runs");
    }
  }
  return files;
}

}  // namespace armature::generate::internal
