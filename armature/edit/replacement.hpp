// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace armature::edit {

/// Bytes [begin, end) of a text, and what stands there instead. Lists of them are in the order of
/// the text and do not overlap.
struct Replacement {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::string text;

  friend bool operator==(const Replacement&, const Replacement&) = default;
};

/// `text` with all of them; every byte outside of their ranges stays.
std::string replaced(std::string_view text, const std::vector<Replacement>& replacements);

/// What makes `text` again of `replaced(text, replacements)`, to the byte.
std::vector<Replacement> inverse_of(std::string_view text,
                                    const std::vector<Replacement>& replacements);

/// `first` of a text of `size` bytes, then `second` of what that gives, as one list for the text.
std::vector<Replacement> composed(std::size_t size, const std::vector<Replacement>& first,
                                  const std::vector<Replacement>& second);

}  // namespace armature::edit
