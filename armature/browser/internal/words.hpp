// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace armature::browser::internal {

using Words = std::vector<std::string>;

/// What names begin with, and what they go on with.
bool is_letter(char c);
bool is_name_character(char c);

/// Without blanks around it.
std::string trimmed(std::string_view text);

/// Separated by blanks and commas; quotes hold together what belongs together.
Words words_of(std::string_view text);

/// `Joint1.GearRatio = 0.02`; of any other line both parts are empty.
struct Assignment {
  explicit Assignment(std::string_view text);

  std::string target;
  std::string value;
};

}  // namespace armature::browser::internal
