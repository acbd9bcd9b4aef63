// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "idl/load.hpp"

namespace armature::idl::internal {

/// Files that are there for a test only, by their paths.
using TestFiles = std::map<std::string, std::string>;

inline ReadFile reader_of(const TestFiles& files) {
  return [&files](const std::string& path) -> base::Result<std::string> {
    const auto found = files.find(path);
    if (found == files.end()) return base::Error{"file '" + path + "' does not exist"};
    return found->second;
  };
}

/// Of one file, `test.idl`.
inline Loaded load_text(const std::string& text) {
  const TestFiles files{{"test.idl", text}};
  return load("test.idl", reader_of(files));
}

}  // namespace armature::idl::internal
