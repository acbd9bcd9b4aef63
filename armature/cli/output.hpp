// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/base/result.hpp"
#include "armature/cli/console.hpp"
#include "armature/document/document.hpp"

namespace armature::cli {

// What commands give; each returns the exit code.

int print(const base::Result<std::string>& text, const Console& console);

int write(const std::string& path, const std::string& content, const Console& console);

/// False, and says so, if `path` is one of the files that `document` came from.
bool is_no_source(const std::string& path, const document::Document& document,
                  const Console& console);

}  // namespace armature::cli
