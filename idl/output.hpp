// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "armature/base/result.hpp"

namespace armature::idl {

/// A file to write, and what is to be in it.
struct OutputFile {
  std::string name;
  std::string content;
};

/// Writes all files into `folder`, which is made if need be. After an error, whose text says why,
/// every file is what it was before. A file that has its content already is not touched.
base::Result<void> write_files(const std::string& folder, const std::vector<OutputFile>& files);

}  // namespace armature::idl
