// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/diagnostic.hpp"

namespace armature::idl {

/// The text of one file, and where in it something is.
class Source {
 public:
  Source(std::string file, std::string text);

  const std::string& file() const { return file_; }
  std::string_view text() const { return text_; }

  /// Line and column, counted in characters, of a byte; of the end for one behind it.
  base::Location location(std::size_t offset) const;

  /// A line without its end, counted from 1; empty if there is none of that number.
  std::string_view line(int number) const;

 private:
  std::string file_;
  std::string text_;
  std::vector<std::size_t> line_begins_;
};

/// All findings ordered by their places, each followed by its source line, a caret below the place
/// and the hint:
///
///     vision.idl:3:5: error: unknown type 'strin'
///         strin name;
///         ^~~~~
///         hint: did you mean 'String'?
std::string to_text(const base::Diagnostics& diagnostics,
                    const std::vector<const Source*>& sources);

}  // namespace armature::idl
