// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

/// What a user most likely did where the YAML parser found a syntax error.
namespace armature::document {

/// A bracket or quote without its other half.
struct Unclosed {
  char what = '\0';  ///< `[`, `{`, `'` or `"`
  std::size_t at = 0;
};

/// The last bracket or quote in `text` that is open at its end, or where another bracket closes.
std::optional<Unclosed> find_unclosed(std::string_view text);

/// How to mend a line that is no YAML; empty if nothing comes to mind.
std::string hint_for_line(std::string_view line);

}  // namespace armature::document
