// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/base/result.hpp"
#include "armature/deploy/document.hpp"

namespace armature::deploy {

/// The content of a file, or why it cannot be read.
using FileReader = std::function<base::Result<std::string>(const std::string& path)>;

/// Beyond these a document is refused, so that a small file cannot fill the memory.
struct Limits {
  std::size_t file_bytes = 16u << 20;
  std::size_t nodes = 500'000;             ///< texts, lists and maps in one file
  std::size_t expanded_nodes = 5'000'000;  ///< after ranges, parameters and composites
  /// Components, composites and connections after ranges and composites; counted before they are
  /// made.
  std::size_t expanded_entries = 200'000;
  int depth = 64;  ///< of lists and maps inside each other
  int includes = 1000;
};

/// What reading a document needs beside its file.
struct LoadOptions {
  FileReader read;  ///< empty: from disk
  /// As on the command line: `joints=7` sets a parameter, `Joint1.GearRatio=0.02` a property,
  /// `Joint1.activity.periodic=5 ms` an activity; values are YAML.
  std::vector<std::string> overrides;
  Limits limits;
};

/// Reads a deployment and all it includes: OROCOS XML if the name ends in `.xml` or `.cpf`, else
/// YAML. Adds every mistake to `diagnostics`; with errors among them the document has what could be
/// read.
Document load_document(const std::string& path, const LoadOptions& options,
                       base::Diagnostics& diagnostics);

/// Likewise for text that is in memory; `name` tells where it is from and chooses the format.
Document parse_document(std::string_view text, const std::string& name, const LoadOptions& options,
                        base::Diagnostics& diagnostics);

/// Changes one property or activity setting: `Joint1.GearRatio=0.02`.
void apply_override(Document& document, std::string_view setting, base::Diagnostics& diagnostics);

/// The document in YAML, in its short forms; reads back as the same document.
std::string write_yaml(const Document& document);

/// The document as an OROCOS deployer file. What OROCOS has no word for is written in attributes
/// `armature:...`, which OROCOS ignores; a note for each such thing says so.
std::string write_xml(const Document& document, base::Diagnostics& diagnostics);

/// Reads an OROCOS property file (.cpf).
std::vector<Property> parse_cpf(std::string_view text, const std::string& name,
                                base::Diagnostics& diagnostics, const Limits& limits = {});

/// Writes an OROCOS property file. Give each value the OROCOS `type` that its text does not show.
std::string write_cpf(const std::vector<Property>& properties);

}  // namespace armature::deploy
