// SPDX-License-Identifier: Apache-2.0
#include "armature/bundle/internal/deployment_files.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "armature/deploy/load.hpp"
#include "armature/document/document.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/orocos/property_file.hpp"
#include "armature/platform/file.hpp"
#include "idl/load.hpp"

namespace armature::bundle::internal {
namespace {

namespace fs = std::filesystem;
using document::path_in_quotes;
using document::Value;

/// The deployment is loaded as if it lay below this folder: then a path that follows from where it
/// lies begins with it, and one that does not is absolute.
constexpr std::string_view kElsewhere = "/the bundled deployment";

std::string elsewhere(const std::string& path) { return std::string(kElsewhere) + path; }

bool follows_the_deployment(std::string_view path) {
  return path.starts_with(kElsewhere) && path.substr(kElsewhere.size()).starts_with('/');
}

std::string here(const std::string& path) {
  return follows_the_deployment(path) ? path.substr(kElsewhere.size()) : path;
}

base::Location here(base::Location where) {
  where.file = here(where.file);
  return where;
}

bool is_there(const std::string& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

bool is_file(const std::string& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

/// The texts in quotes behind each `word`, with nothing but letters of `between` before them.
std::set<std::string> quoted_behind(std::string_view word, std::string_view between,
                                    std::string_view text) {
  std::set<std::string> found;
  for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + 1)) {
    const std::size_t open = text.find_first_not_of(between, at + word.size());
    if (open == text.npos || (text[open] != '"' && text[open] != '\'')) continue;
    const std::size_t close = text.find(text[open], open + 1);
    if (close != text.npos) found.emplace(text.substr(open + 1, close - open - 1));
  }
  return found;
}

class Finder {
 public:
  Finder(const DeploymentSource& source, base::Diagnostics& diagnostics)
      : source_(source), diagnostics_(diagnostics) {}

  DeploymentFiles find() {
    const document::Document document = load();
    for (const document::Reference& library : document.libraries) add_library(library, document);
    for (const document::Component& component : document.components) add(component, document);
    add(document.network, document);
    if (!source_.script.empty()) add_script(source_.script);
    return std::move(found_);
  }

 private:
  /// Its own files are those that are read.
  document::Document load() {
    deploy::LoadOptions options;
    options.overrides = source_.overrides;
    options.read = [this](const std::string& path) {
      auto text = platform::read_file(here(path));
      if (text) add(path, "an included file", {source_.file, 0, 0});
      return text;
    };
    base::Diagnostics known;  // the check has told them
    return deploy::load_document(elsewhere(source_.file), options, known);
  }

  /// @param path  as if the deployment lay elsewhere
  /// @return where the file really is; nothing if it would not be found in another place
  std::optional<std::string> take(const std::string& path, const std::string& what,
                                  const base::Location& where) {
    if (!follows_the_deployment(path)) {
      const bool absolute = path.starts_with('/');
      diagnostics_.error(
          here(where),
          what +
              (absolute ? " has the absolute path " : " is found in the working directory, as ") +
              path_in_quotes(path) + ", which another machine does not have",
          "name it relative to this file; in a property write \"${here}/...\"");
      return std::nullopt;
    }
    const std::string written = here(path);
    std::string plain = fs::path(written).lexically_normal().string();
    if (plain != written && is_there(written) && !platform::is_same_file(plain, written)) {
      diagnostics_.error(here(where),
                         path_in_quotes(written) +
                             " leads over a link, so '..' is not the folder "
                             "that the name says",
                         "name the file without the link");
      return std::nullopt;
    }
    return plain;
  }

  std::optional<std::string> add(const std::string& path, const std::string& what,
                                 const base::Location& where) {
    auto file = take(path, what, where);
    if (file) found_.files.emplace(*file, here(where));
    return file;
  }

  void add_library(const document::Reference& library, const document::Document& document) {
    if (library.name.find('/') == std::string::npos) return;
    const auto file = add(path_from(document, library.name), "component library", library.where);
    if (file) found_.libraries.insert(*file);
  }

  void add(const document::Component& component, const document::Document& document) {
    for (const document::PropertyFile& file : component.property_files) {
      add_property_file(component, file, document);
    }
    for (const document::Property& property : component.properties) {
      look_at(property.value, "property '" + property.name + "' of '" + component.name + "'");
    }
    if (!component.interface.name.empty()) add_interface(component.interface, document);
  }

  void add_property_file(const document::Component& component, const document::PropertyFile& file,
                         const document::Document& document) {
    const auto path = take(path_from(document, file.path), "property file", file.where);
    if (!path) return;
    if (component.autosave && &file == &component.property_files.back()) found_.saved.insert(*path);
    const auto text = platform::read_file(*path);
    if (!text) return;  // the check has told it, or a run is yet to write it
    found_.files.emplace(*path, here(file.where));
    base::Diagnostics known;
    for (const auto& property : orocos::parse_cpf(text.value(), *path, known)) {
      look_at(property.value, "property '" + property.name + "' of '" + component.name + "'");
    }
  }

  void add_interface(const document::Reference& interface, const document::Document& document) {
    const std::string path =
        path_from(document, interface.name.substr(0, interface.name.find('#')));
    const auto file = take(path, "interface file", interface.where);
    if (!file) return;
    const idl::Loaded loaded = idl::load(*file);
    for (const idl::Module& module : loaded.program.modules()) {
      add(elsewhere(module.file), "interface file", interface.where);
    }
  }

  /// Which properties are files is known to their components alone: a text that names one is it.
  void look_at(const Value& value, const std::string& what) {
    for (const Value& item : value.items) look_at(item, what);
    for (const document::Property& entry : value.entries) look_at(entry.value, what);
    const std::string& text = value.text;
    if (value.kind != Value::Kind::kText || !is_file(here(text))) return;
    if (text.front() == '/') {
      const auto file = add(text, what, value.where);
      if (file && file->ends_with(".urdf")) add_meshes(*file);
    } else if (text.find_first_of("./") != std::string::npos) {
      diagnostics_.warning(here(value.where),
                           what + " is " + path_in_quotes(text) +
                               ", a file that counts from the working directory: it is left out",
                           "write \"${here}/...\", which counts from this file");
    }
  }

  /// Armature needs none of them, but whoever shows the robot does.
  void add_meshes(const std::string& urdf) {
    const auto text = platform::read_file(urdf);
    if (!text) return;
    const fs::path folder = fs::path(urdf).parent_path();
    for (const std::string& name : quoted_behind("filename", " \t\r\n=", text.value())) {
      const std::string file = (folder / name).string();
      if (is_file(file) && !name.starts_with('/')) {
        add(elsewhere(file), "mesh", {urdf, 0, 0});
      } else {
        diagnostics_.note({urdf, 0, 0}, "the mesh " + path_in_quotes(name) +
                                            " is left out, expected a path relative to this file "
                                            "(Armature itself needs no meshes)");
      }
    }
  }

  void add(const document::Network& network, const document::Document& document) {
    const auto place = [&](const document::Reference& file) {
      return path_from(document, file.name);
    };
    if (!network.policy.name.empty()) add(place(network.policy), "policy", network.policy.where);
    for (const document::Reference* file : {&network.certificate, &network.authority}) {
      if (!file->name.empty()) add(place(*file), "certificate", file->where);
    }
    if (!network.key.name.empty()) {
      const auto key = take(place(network.key), "private key", network.key.where);
      if (key) found_.keys.insert(*key);
    }
    if (network.pages.name.empty()) return;
    const auto pages = take(place(network.pages), "the folder of pages", network.pages.where);
    if (pages) add_folder(*pages, here(network.pages.where));
  }

  /// Pages are served from their folder alone, so a link to something else leads nowhere.
  void add_folder(const std::string& folder, const base::Location& where) {
    std::error_code failure;
    for (fs::recursive_directory_iterator each(folder, failure), end; !failure && each != end;
         each.increment(failure)) {
      const std::string path = each->path().string();
      std::error_code ignored;
      if (each->is_symlink(ignored)) {
        diagnostics_.note(where, path_in_quotes(path) + " is a link: it is left out");
      } else if (each->is_regular_file(ignored)) {
        found_.files.emplace(path, where);
      }
    }
    if (failure) diagnostics_.error(where, path_in_quotes(folder) + ": " + failure.message());
  }

  /// With those that it requires, which lie beside it.
  void add_script(const std::string& path) {
    const bool known = !found_.files.emplace(path, base::Location{path, 0, 0}).second;
    const auto text = platform::read_file(path);
    if (known || !text) return;
    for (const std::string& name : quoted_behind("require", " \t\r\n(", text.value())) {
      const std::string file = (fs::path(path).parent_path() / (name + ".lua")).string();
      if (is_file(file)) add_script(file);
    }
  }

  const DeploymentSource& source_;
  base::Diagnostics& diagnostics_;
  DeploymentFiles found_;
};

}  // namespace

DeploymentFiles find_files(const DeploymentSource& source, base::Diagnostics& diagnostics) {
  return Finder(source, diagnostics).find();
}

}  // namespace armature::bundle::internal
