// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "armature/base/diagnostic.hpp"

namespace armature::canopen::internal {

/// `Key=value` in a file, and where.
struct IniEntry {
  std::string key;  ///< in lower case, without blanks around it
  std::string value;
  int line = 0;
};

/// What stands below `[name]`.
struct IniSection {
  std::string name;  ///< in lower case
  int line = 0;
  std::vector<IniEntry> entries;

  /// nullptr if there is none.
  /// @param key  in lower case
  const IniEntry* find(std::string_view key) const;
};

/// Letters of ASCII as small ones.
std::string lower_case(std::string_view text);

/// The sections of a file as CiA 306 has them; lines that begin with ';' or '#' are comments.
/// Mistakes go to `diagnostics`, and what can be read is read.
std::vector<IniSection> parse_ini(std::string_view text, const std::string& file,
                                  base::Diagnostics& diagnostics);

}  // namespace armature::canopen::internal
