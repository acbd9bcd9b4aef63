// SPDX-License-Identifier: Apache-2.0
#include "armature/replay/own_files.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <vector>

#include "armature/component/interface.hpp"
#include "armature/component/properties/property.hpp"
#include "armature/platform/file.hpp"
#include "armature/replay/small_text.hpp"

namespace armature::replay {
namespace {

namespace fs = std::filesystem;
using component::PropertyBase;
using Contents = Experiment::Contents;

constexpr std::size_t kLargestOwnFile = 16u << 20;
/// Of a folder nothing else is the component's.
constexpr std::string_view kMotion = ".motion";
constexpr std::array<std::string_view, 2> kNames{"poses", "folder"};

std::string path_of(const PropertyBase& property) {
  return types::to_text(property.type(), property.data());
}

std::string key_of(const component::Component& owner, const PropertyBase& property) {
  return owner.name() + '.' + std::string(property.name());
}

/// The properties that lead to files of a component. What an observer names is where it records.
std::vector<PropertyBase*> own_files_of(component::Component& component) {
  const component::Interface& interface = component::interface_of(component);
  std::vector<PropertyBase*> own;
  if (!interface.observers.empty()) return own;
  for (PropertyBase* const property : interface.properties) {
    const bool text = property->type().kind == types::Kind::kText;
    if (text && names_own_files(property->name()) && !path_of(*property).empty()) {
      own.push_back(property);
    }
  }
  return own;
}

Contents contents_of(const std::string& path) {
  Contents contents;
  const auto add = [&contents](const std::string& name, const std::string& file) {
    if (auto text = small_text(file, kLargestOwnFile)) contents.emplace(name, std::move(*text));
  };
  std::error_code ignored;
  if (!fs::is_directory(path, ignored)) {
    add("", path);
    return contents;
  }
  for (const auto& entry : fs::directory_iterator(path, ignored)) {
    if (entry.path().extension() == kMotion) {
      add(entry.path().filename().string(), entry.path().string());
    }
  }
  return contents;
}

/// Each name is one that lies in `place`, whoever wrote the experiment.
void write_copies(const Contents& contents, const std::string& place,
                  base::Diagnostics& diagnostics) {
  for (const auto& [name, text] : contents) {
    std::error_code ignored;
    if (!name.empty()) fs::create_directories(place, ignored);
    const fs::path file =
        name.empty() ? fs::path(place) : fs::path(place) / fs::path(name).filename();
    const auto written = platform::write_file(file.string(), text);
    if (!written) diagnostics.error({}, written.error());
  }
}

}  // namespace

bool names_own_files(std::string_view property) {
  return std::ranges::find(kNames, property) != kNames.end();
}

void keep_own_files(const exec::Blueprint& blueprint, Experiment& to) {
  for (const exec::ComponentEntry& entry : blueprint.components) {
    for (const PropertyBase* const property : own_files_of(*entry.component)) {
      to.own.insert_or_assign(key_of(*entry.component, *property), contents_of(path_of(*property)));
    }
  }
}

void work_on_copies(exec::Blueprint& blueprint, const Experiment& experiment,
                    const std::string& folder, base::Diagnostics& diagnostics) {
  for (exec::ComponentEntry& entry : blueprint.components) {
    for (PropertyBase* const property : own_files_of(*entry.component)) {
      const std::string key = key_of(*entry.component, *property);
      const auto then = experiment.own.find(key);
      std::error_code ignored;
      fs::create_directories(folder + "/own", ignored);
      const std::string copy = folder + "/own/" + key;
      write_copies(then == experiment.own.end() ? contents_of(path_of(*property)) : then->second,
                   copy, diagnostics);
      const auto set = property->set(types::Value::of(copy));
      if (!set) diagnostics.error({}, "'" + key + "' cannot lead to a copy: " + set.error());
    }
  }
}

}  // namespace armature::replay
