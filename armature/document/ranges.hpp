// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/diagnostic.hpp"

/// Ranges `{1..3}` in texts, and their number: `{i}`, `{i+1}`, `{i-1}`. Anything else in braces is
/// ordinary text.
namespace armature::document {

/// Numbers of a range; never empty.
struct Range {
  int first = 0;
  int last = 0;

  friend bool operator==(const Range&, const Range&) = default;
};

/// `{1..3}` in a text, from `begin` to `end`.
struct RangeInText {
  Range range;
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// The first range in `text`. An impossible one is an error, a text without one is not.
std::optional<RangeInText> find_range(std::string_view text, const base::Location& where,
                                      base::Diagnostics& diagnostics);

/// True if there is a `{...}` with two dots in it: a range, possible or not.
bool has_range(std::string_view text);

/// The offsets k of each `{i+k}` in `text`.
std::vector<int> number_offsets(std::string_view text);

/// `{i}` and its kin replaced by the number; one below zero is an error.
std::string replace_number(std::string_view text, int number, const base::Location& where,
                           base::Diagnostics& diagnostics);

std::string range_text(const Range& range);

}  // namespace armature::document
