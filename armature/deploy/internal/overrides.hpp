// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/deploy/document.hpp"

namespace armature::deploy::internal {

/// One `--set path=value`.
struct Override {
  std::string path;
  Value value;
  bool used = false;
};

/// Those of `settings` that have the form `path=value`; errors for the others.
std::vector<Override> parse_overrides(const std::vector<std::string>& settings,
                                      base::Diagnostics& diagnostics);

/// Takes those out whose path is `prefix` and one more name, as properties of that name.
std::vector<Property> take_overrides(std::vector<Override>& overrides, std::string_view prefix,
                                     const std::vector<std::string>& names);

void apply_override(Document& document, const Override& setting, base::Diagnostics& diagnostics);

}  // namespace armature::deploy::internal
