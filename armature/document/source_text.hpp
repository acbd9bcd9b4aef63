// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/diagnostic.hpp"

namespace armature::document {

/// Line and column (both from 1, columns in bytes) of byte offsets in a text.
class LineIndex {
 public:
  LineIndex(std::string_view text, std::string file);

  base::Location at(std::size_t offset) const;

 private:
  std::string file_;
  std::size_t size_;
  std::vector<std::size_t> line_starts_;
};

/// The text of a line, counted from 1, without its end; empty if there is no such line.
std::string_view line_of(std::string_view text, int line);

/// True for control characters that neither YAML nor XML files may have: all but tab and line ends.
bool is_forbidden_control(char c);

/// True if `text` is no longer than `limit_bytes`, valid UTF-8 and without control characters but
/// tab and line ends; else says why not.
bool check_source_text(std::string_view text, const std::string& file, std::size_t limit_bytes,
                       base::Diagnostics& diagnostics);

}  // namespace armature::document
