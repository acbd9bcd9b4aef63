// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/base/result.hpp"
#include "idl/model.hpp"
#include "idl/source.hpp"

namespace armature::idl {

/// Gives the content of a file; its error says why there is none.
using ReadFile = std::function<base::Result<std::string>(const std::string& path)>;

/// Reads from the disk, at most kLargestFile bytes.
base::Result<std::string> read_file(const std::string& path);

struct Loaded {
  Program program;  ///< complete only if there was no error
  std::vector<std::unique_ptr<Source>> sources;
  base::Diagnostics diagnostics;

  bool ok() const { return diagnostics.ok(); }
  /// All findings with their source lines.
  std::string findings() const;
};

/// Reads a file and all that it imports, and checks the whole. Every mistake is found in one run.
Loaded load(const std::string& file, const ReadFile& read = read_file);

}  // namespace armature::idl
