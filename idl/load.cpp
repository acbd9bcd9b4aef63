// SPDX-License-Identifier: Apache-2.0
#include "idl/load.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <system_error>
#include <utility>

#include "idl/check.hpp"
#include "idl/limits.hpp"
#include "idl/parser.hpp"

namespace armature::idl {
namespace {

namespace fs = std::filesystem;

std::string join(const std::vector<std::string>& files) {
  std::string text;
  for (const std::string& file : files) text += (text.empty() ? "" : " -> ") + file;
  return text;
}

class Loader {
 public:
  Loader(const ReadFile& read, Loaded& loaded) : read_(read), loaded_(loaded) {}

  /// The name of the module in `file`, or nothing after an error.
  std::optional<std::string> load(const std::string& file, const base::Location& from) {
    if (const auto known = names_.find(file); known != names_.end()) return known->second;
    if (const auto begun = std::find(open_.begin(), open_.end(), file); begun != open_.end()) {
      std::vector<std::string> circle(begun, open_.end());
      circle.push_back(file);
      return fail(from, "files import each other in a circle: " + join(circle),
                  "put what they share into a file of its own");
    }
    if (loaded_.sources.size() >= kMostFiles) {
      return fail(from, "more than " + std::to_string(kMostFiles) + " files import one another");
    }
    if (!file.ends_with(".idl"))
      return fail(from, "expected a file NAME.idl, found '" + file + "'");
    const base::Result<std::string> text = read_(file);
    if (!text) return fail(from, text.error(), hint_of(from));
    loaded_.sources.push_back(std::make_unique<Source>(file, text.value()));
    return parsed(*loaded_.sources.back(), from);
  }

 private:
  std::optional<std::string> parsed(const Source& source, const base::Location& from) {
    Module module = parse(source, loaded_.diagnostics);
    module.name = fs::path(source.file()).stem().string();
    for (Structure& structure : module.structures) structure.module = module.name;
    for (Enumeration& each : module.enumerations) each.module = module.name;
    refuse_same_name(module, from);
    open_.push_back(source.file());
    for (Import& import : module.imports) {
      const fs::path path = fs::path(source.file()).parent_path() / import.path;
      import.module = load(path.lexically_normal().string(), import.where).value_or("");
      module.complete = module.complete && !import.module.empty();
    }
    open_.pop_back();
    names_[source.file()] = module.name;
    std::string name = module.name;
    loaded_.program.add(std::move(module));
    return name;
  }

  /// Both would be written to files of the same names.
  void refuse_same_name(const Module& module, const base::Location& from) {
    const auto [first, is_new] = files_.emplace(module.name, module.file);
    if (is_new) return;
    fail(from,
         "'" + module.file + "' and '" + first->second + "' have the same name, " + module.name +
             ", and so would the files generated from them",
         "rename one of them");
  }

  std::nullopt_t fail(const base::Location& where, std::string message, std::string hint = {}) {
    loaded_.diagnostics.error(where, std::move(message), std::move(hint));
    return std::nullopt;
  }

  static std::string hint_of(const base::Location& from) {
    if (from.line == 0) return {};
    return "the path is relative to the folder of the file that imports it";
  }

  const ReadFile& read_;
  Loaded& loaded_;
  std::vector<std::string> open_;             ///< files whose imports are being loaded
  std::map<std::string, std::string> names_;  ///< of modules, by their files
  std::map<std::string, std::string> files_;  ///< the other way round
};

}  // namespace

base::Result<std::string> read_file(const std::string& path) {
  std::error_code failure;
  if (!fs::is_regular_file(path, failure)) {
    return base::Error{"file '" + path + "' does not exist"};
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) return base::Error{"cannot read '" + path + "'"};
  const auto size = fs::file_size(path, failure);
  if (failure || size > kLargestFile) {
    return base::Error{"'" + path + "' has more than " + std::to_string(kLargestFile) + " bytes"};
  }
  return std::string(std::istreambuf_iterator<char>(file), {});
}

std::string Loaded::findings() const {
  std::vector<const Source*> all;
  for (const auto& source : sources) all.push_back(source.get());
  return to_text(diagnostics, all);
}

Loaded load(const std::string& file, const ReadFile& read) {
  Loaded loaded;
  Loader(read, loaded).load(file, {file, 0, 0});
  check(loaded.program, loaded.diagnostics);
  return loaded;
}

}  // namespace armature::idl
