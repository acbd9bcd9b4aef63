// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>

#include "armature/deploy/load.hpp"
#include "armature/document/yaml.hpp"
#include "armature/orocos/deployer_file.hpp"

/// What the fuzz targets of deployment documents have in common.
namespace armature::fuzz {

/// Small enough that a refused document costs no time.
inline deploy::LoadOptions options() {
  deploy::LoadOptions options;
  options.limits.file_bytes = 1u << 16;
  options.limits.nodes = 20'000;
  options.limits.expanded_nodes = 100'000;
  options.read = [](const std::string& path) -> base::Result<std::string> {
    if (path == "part.yaml") return std::string("components: {Part: {model: Part}}");
    if (path == "part.xml") return std::string("<properties/>");
    return base::Error{"file '" + path + "' does not exist"};
  };
  return options;
}

[[noreturn]] inline void fail(const char* what, const std::string& before,
                              const std::string& after) {
  std::fprintf(stderr, "%s\n--- before\n%s\n--- after\n%s\n", what, before.c_str(), after.c_str());
  std::abort();
}

/// `text` must read as the document whose YAML is `yaml`.
inline void check_same(const std::string& text, const char* name, const std::string& yaml) {
  base::Diagnostics diagnostics;
  const document::Document again = deploy::parse_document(text, name, {}, diagnostics);
  if (!diagnostics.ok()) fail(diagnostics.to_text().c_str(), yaml, text);
  if (const std::string after = document::write_yaml(again); after != yaml) {
    fail("the document has changed", yaml, after);
  }
}

/// A document without errors is the same after it was written and read, in both formats.
inline void check_round_trip(const document::Document& document) {
  const std::string yaml = document::write_yaml(document);
  check_same(yaml, "again.yaml", yaml);
  base::Diagnostics of_writing;
  const std::string xml = orocos::write_xml(document, of_writing);
  if (of_writing.ok()) check_same(xml, "again.xml", yaml);
}

}  // namespace armature::fuzz
