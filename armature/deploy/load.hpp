// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/base/result.hpp"
#include "armature/document/document.hpp"
#include "armature/document/limits.hpp"

namespace armature::deploy {

/// The content of a file, or why it cannot be read.
using FileReader = std::function<base::Result<std::string>(const std::string& path)>;

/// Is told of a file that was read.
using FileSeen = std::function<void(const std::string& path, const std::string& text)>;

/// What reading a document needs beside its file.
struct LoadOptions {
  FileReader read;  ///< empty: from disk
  /// Is told each file that was read, property files included.
  FileSeen seen;
  /// As on the command line: `joints=7` sets a parameter, `Joint1.GearRatio=0.02` a property,
  /// `Joint1.activity.periodic=5 ms` an activity; values are YAML.
  std::vector<std::string> overrides;
  document::Limits limits;
};

/// Reads a deployment and all it includes: OROCOS XML if the name ends in `.xml` or `.cpf`, else
/// YAML. Adds every mistake to `diagnostics`; with errors among them the document has what could be
/// read.
document::Document load_document(const std::string& path, const LoadOptions& options,
                                 base::Diagnostics& diagnostics);

/// Likewise for text that is in memory; `name` tells where it is from and chooses the format.
document::Document parse_document(std::string_view text, const std::string& name,
                                  const LoadOptions& options, base::Diagnostics& diagnostics);

/// Changes one property or activity setting: `Joint1.GearRatio=0.02`.
void apply_override(document::Document& document, std::string_view setting,
                    base::Diagnostics& diagnostics);

}  // namespace armature::deploy
