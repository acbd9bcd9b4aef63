// SPDX-License-Identifier: Apache-2.0
#include "armature/replay/recorded_deployment.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "armature/base/hash64.hpp"
#include "armature/base/joined.hpp"
#include "armature/component/interface.hpp"
#include "armature/component/properties/property.hpp"
#include "armature/deploy/loader.hpp"
#include "armature/platform/file.hpp"
#include "armature/replay/own_files.hpp"
#include "armature/replay/small_text.hpp"
#include "armature/runner/fingerprint.hpp"

namespace armature::replay {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestFile = 1u << 20;

/// The path that a property's value is; empty if it is none.
std::string path_in(const component::PropertyBase& property) {
  if (property.type().kind != types::Kind::kText) return {};
  std::string text = types::to_text(property.type(), property.data());
  std::error_code ignored;
  const bool is_path = text.find('/') != std::string::npos && fs::is_regular_file(text, ignored);
  return is_path ? text : std::string();
}

void add_named_files(const exec::Blueprint& blueprint, Experiment& to) {
  for (const exec::ComponentEntry& entry : blueprint.components) {
    const component::Interface& interface = component::interface_of(*entry.component);
    if (!interface.observers.empty()) continue;  // what they name they write
    for (const component::PropertyBase* property : interface.properties) {
      if (names_own_files(property->name())) continue;
      const std::string path = path_in(*property);
      if (path.empty()) continue;
      if (!to.files.contains(path)) {
        auto content = small_text(path, kLargestFile);
        if (!content) continue;
        to.files.emplace(path, std::move(*content));
      }
      to.named.emplace(entry.component->name() + '.' + std::string(property->name()), path);
    }
  }
}

std::vector<UsedLibrary> used_libraries(const document::Document& document,
                                        const std::vector<std::string>& first) {
  const auto folders = deploy::library_folders(first, document.file);
  std::vector<UsedLibrary> used;
  for (const document::Reference& library : document.libraries) {
    const auto file = deploy::find_library(library.name, folders);
    if (!file || std::ranges::find(used, library.name, &UsedLibrary::name) != used.end()) continue;
    const auto content = platform::read_file(file.value());
    used.push_back({library.name, file.value(), content ? base::hash64_text(content.value()) : ""});
  }
  return used;
}

/// However a path is written.
std::string normal(const std::string& path) {
  std::error_code ignored;
  return fs::absolute(path, ignored).lexically_normal().string();
}

/// Reads from what the run has read; with `more`, what that includes is read from disk.
deploy::FileReader reader_of(const Experiment& experiment, bool more) {
  std::map<std::string, std::string> texts;
  for (const auto& [path, text] : experiment.texts) texts.emplace(normal(path), text);
  return [texts, more](const std::string& path) -> base::Result<std::string> {
    if (const auto known = texts.find(normal(path)); known != texts.end()) return known->second;
    if (more) return platform::read_file(path);
    return base::Error{"the recorded run did not read '" + path + "'"};
  };
}

/// Writes to `out` what is not there any more as it was.
/// @return overrides of the properties that name it
std::vector<std::string> restore_files(const Experiment& experiment, const std::string& out,
                                       base::Diagnostics& diagnostics) {
  std::vector<std::string> overrides;
  for (const auto& [path, content] : experiment.files) {
    const auto present = platform::read_file(path, kLargestFile);
    if (present && present.value() == content) continue;
    const std::string copy = out + "/was-" + base::hash64_text(path).substr(0, 8) + '-' +
                             fs::path(path).filename().string();
    const auto written = platform::write_file(copy, content);
    if (!written) {
      diagnostics.error({}, written.error());
      continue;
    }
    diagnostics.note({}, "'" + path + "' is not what it was when the run was recorded; '" + copy +
                             "' is, and is used");
    for (const auto& [property, named] : experiment.named) {
      if (named == path) overrides.push_back(property + "='" + copy + "'");
    }
  }
  return overrides;
}

void warn_of_libraries(const Experiment& experiment, const document::Document& document,
                       const std::vector<std::string>& first, base::Diagnostics& diagnostics) {
  const auto used = used_libraries(document, first);
  for (const UsedLibrary& then : experiment.libraries) {
    const auto now = std::ranges::find(used, then.name, &UsedLibrary::name);
    if (now == used.end() || now->hash == then.hash) continue;
    diagnostics.warning({},
                        "component library '" + then.name + "' (" + now->file +
                            ") is not the one that was recorded: what differs may be its doing");
  }
}

/// Names the first lines that differ.
void warn_of_outline(const std::string& then, const std::string& now,
                     base::Diagnostics& diagnostics) {
  constexpr int kMostLines = 5;
  std::string_view old = then;
  std::string_view present = now;
  std::string component;
  int told = 0;
  while ((!old.empty() || !present.empty()) && told < kMostLines) {
    const std::string_view a = old.substr(0, old.find('\n'));
    const std::string_view b = present.substr(0, present.find('\n'));
    if (a.starts_with("component ")) component = std::string(a.substr(0, a.find(" model ")));
    if (a != b) {
      ++told;
      diagnostics.warning({}, "the deployment is not what it was: " + component + ": '" +
                                  std::string(a) + "' was recorded, '" + std::string(b) +
                                  "' is here");
      if (a.substr(0, a.find(" = ")) != b.substr(0, b.find(" = "))) return;  // all others differ
    }
    old.remove_prefix(std::min(old.size(), a.size() + 1));
    present.remove_prefix(std::min(present.size(), b.size() + 1));
  }
}

/// A file that changes the recorded deployment is one that includes it, so its entries win.
base::Result<std::string> text_with(const Experiment& experiment, const std::string& file) {
  const auto text = platform::read_file(file);
  if (!text) return base::Error{text.error()};
  if (('\n' + text.value()).find("\ninclude:") != std::string::npos) {
    return base::Error{"'" + file +
                       "' includes other files, but here it is added to the recorded deployment: "
                       "remove include, and write what is to change into it"};
  }
  // In the last line, so that places in the file stay what they are.
  return text.value() + "\ninclude: '" + normal(experiment.deployment) + "'\n";
}

document::Document parse(const Experiment& experiment, const Changes& changes,
                         const std::string& text, const deploy::LoadOptions& options,
                         base::Diagnostics& diagnostics) {
  if (changes.file.empty()) {
    return deploy::load_document(experiment.deployment, options, diagnostics);
  }
  return deploy::parse_document(text, changes.file, options, diagnostics);
}

std::string folder_of(const std::string& file) {
  std::error_code ignored;
  return fs::weakly_canonical(fs::absolute(file, ignored), ignored).parent_path().string();
}

/// The folder of a run may be somebody else's: it does not say which code is run. Libraries are
/// those of `-L` and of the usual places, but for the one beside the deployment.
void expect_trusted_libraries(const Experiment& experiment, const document::Document& document,
                              const std::vector<std::string>& first,
                              base::Diagnostics& diagnostics) {
  std::vector<std::string> trusted = deploy::library_folders(first, "");
  trusted.pop_back();
  for (std::string& folder : trusted) folder = folder_of(folder + "/any");
  const std::vector<std::string> searched = deploy::library_folders(first, document.file);
  const std::string used = base::joined(experiment.library_folders);
  const std::string hint =
      used.empty() ? "name its folder with -L" : "name its folder with -L; the run had -L " + used;
  for (const document::Reference& library : document.libraries) {
    const auto file = deploy::find_library(library.name, searched);
    if (!file) {
      diagnostics.error(library.where, file.error(), hint);
    } else if (std::ranges::find(trusted, folder_of(file.value())) == trusted.end()) {
      diagnostics.error(library.where,
                        "component library '" + library.name + "' would be '" + file.value() +
                            "', which the folder of the run alone says",
                        hint);
    }
  }
}

}  // namespace

deploy::Deployment load_recorded(const Experiment& experiment, const Changes& changes,
                                 const std::string& out, const deploy::DeploymentOptions& options) {
  base::Diagnostics found;
  deploy::DeploymentOptions all = options;
  all.document.read = reader_of(experiment, !changes.file.empty());
  all.document.overrides = experiment.overrides;
  for (std::string& copy : restore_files(experiment, out, found)) {
    all.document.overrides.push_back(std::move(copy));
  }
  all.document.overrides.insert(all.document.overrides.end(), changes.overrides.begin(),
                                changes.overrides.end());
  all.mode = experiment.mode;
  deploy::Deployment deployment;
  std::string text;
  if (!changes.file.empty()) {
    auto changed = text_with(experiment, changes.file);
    if (!changed) {
      deployment.diagnostics.error({changes.file, 0, 0}, changed.error());
      return deployment;
    }
    text = std::move(changed).value();
  }
  deployment.document = parse(experiment, changes, text, all.document, deployment.diagnostics);
  expect_trusted_libraries(experiment, deployment.document, all.library_folders,
                           deployment.diagnostics);
  if (!deployment.ok()) return deployment;
  deployment = changes.file.empty() ? deploy::load_deployment(experiment.deployment, all)
                                    : deploy::parse_deployment(text, changes.file, all);
  warn_of_libraries(experiment, deployment.document, all.library_folders, found);
  if (deployment.ok() && !changes.any()) {
    warn_of_outline(experiment.outline, runner::outline(deployment.blueprint, deployment.options),
                    found);
  }
  deployment.diagnostics.append(found);
  return deployment;
}

base::Result<void> write_changes(const std::string& path, const Changes& changes,
                                 const std::set<std::string>& only) {
  nlohmann::json all = nlohmann::json::array();
  if (!changes.file.empty()) all.push_back("with " + fs::path(changes.file).filename().string());
  for (const std::string& one : changes.overrides) all.push_back(one);
  nlohmann::json json{{"changes", all}};
  if (!only.empty()) json["only"] = only;
  return platform::write_file(
      path, json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + '\n');
}

Experiment experiment_of(const deploy::Deployment& deployment,
                         std::map<std::string, std::string> texts, const Ran& how) {
  Experiment experiment;
  std::error_code ignored;
  experiment.folder = fs::current_path(ignored).string();
  experiment.deployment = deployment.document.file;
  experiment.application = deployment.blueprint.name;
  experiment.version = how.version;
  experiment.simulated = how.simulated;
  experiment.overrides = how.overrides;
  experiment.mode = how.mode;
  experiment.library_folders = how.library_folders;
  experiment.libraries = used_libraries(deployment.document, how.library_folders);
  experiment.texts = std::move(texts);
  add_named_files(deployment.blueprint, experiment);
  keep_own_files(deployment.blueprint, experiment);
  experiment.outline = runner::outline(deployment.blueprint, deployment.options);
  return experiment;
}

}  // namespace armature::replay
