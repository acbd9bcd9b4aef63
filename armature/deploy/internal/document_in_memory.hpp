// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "armature/deploy/load.hpp"
#include "armature/document/yaml.hpp"

/// For tests: documents whose files are in memory.
namespace armature::deploy::internal {

using namespace document;

struct Loaded {
  Document document;
  base::Diagnostics diagnostics;

  std::string messages() const { return diagnostics.to_text(); }
  std::string yaml() const { return write_yaml(document); }
};

using Files = std::map<std::string, std::string>;

inline LoadOptions options_with(const Files& files) {
  LoadOptions options;
  options.read = [files](const std::string& path) -> base::Result<std::string> {
    const auto found = files.find(path);
    if (found == files.end()) return base::Error{"file '" + path + "' does not exist"};
    return found->second;
  };
  return options;
}

inline Loaded load_files(const std::string& path, const Files& files,
                         const std::vector<std::string>& overrides = {}) {
  Loaded loaded;
  LoadOptions options = options_with(files);
  options.overrides = overrides;
  loaded.document = load_document(path, options, loaded.diagnostics);
  return loaded;
}

inline Loaded load_yaml(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return load_files("robot.yaml", {{"robot.yaml", text}}, overrides);
}

inline Loaded load_xml(const std::string& text) {
  return load_files("robot.xml", {{"robot.xml", text}});
}

inline Loaded load_xml_body(const std::string& elements) {
  return load_xml("<properties>\n" + elements + "\n</properties>\n");
}

}  // namespace armature::deploy::internal
