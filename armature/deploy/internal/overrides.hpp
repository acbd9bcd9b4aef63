// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/document/document.hpp"

namespace armature::deploy::internal {

using namespace document;

/// One `--set path=value`.
struct Override {
  std::string path;
  Value value;
  bool used = false;

  bool names_parameter() const { return path.find('.') == std::string::npos; }
};

/// Where what `--set` gives stands, in place of a file.
inline constexpr std::string_view kCommandLineName = "<command line>";

/// Those of `settings` that have the form `path=value`, one for each number of a range in a path
/// (`Joint{1..3}.GearRatio=0.02`); errors for the others.
std::vector<Override> parse_overrides(const std::vector<std::string>& settings,
                                      base::Diagnostics& diagnostics);

/// Takes those out whose path is `prefix` and one more name, as properties of that name.
std::vector<Property> take_overrides(std::vector<Override>& overrides, std::string_view prefix,
                                     const std::vector<std::string>& names);

/// Says that there is no such parameter, and how a property of that name is set.
/// @param known  the parameters that there are
void refuse_parameter(const Document& document, const Override& setting,
                      const std::vector<std::string>& known, base::Diagnostics& diagnostics);

void apply_override(Document& document, const Override& setting, base::Diagnostics& diagnostics);

}  // namespace armature::deploy::internal
