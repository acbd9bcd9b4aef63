// SPDX-License-Identifier: Apache-2.0
#include "armature/browser/internal/words.hpp"

#include <cctype>
#include <utility>

namespace armature::browser::internal {

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_name_character(char c) {
  return is_letter(c) || std::isdigit(static_cast<unsigned char>(c)) != 0;
}

std::string trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r\n";
  const std::size_t begin = text.find_first_not_of(kBlank);
  if (begin == std::string_view::npos) return {};
  return std::string(text.substr(begin, text.find_last_not_of(kBlank) - begin + 1));
}

Words words_of(std::string_view text) {
  Words words;
  std::string word;
  char quote = '\0';
  for (const char c : text) {
    if (quote != '\0' || (c != ' ' && c != ',' && c != '\t')) {
      if (c == '"' || c == '\'') quote = quote == c ? '\0' : quote == '\0' ? c : quote;
      word += c == '\'' ? '"' : c;
    } else if (!word.empty()) {
      words.push_back(std::exchange(word, {}));
    }
  }
  if (!word.empty()) words.push_back(word);
  return words;
}

Assignment::Assignment(std::string_view text) {
  const std::size_t equals = text.find('=');
  const bool one = equals != std::string_view::npos && equals > 0 && equals + 1 < text.size() &&
                   text[equals + 1] != '=' &&
                   std::string_view("<>~=").find(text[equals - 1]) == std::string_view::npos;
  if (!one) return;
  target = trimmed(text.substr(0, equals));
  value = trimmed(text.substr(equals + 1));
}

}  // namespace armature::browser::internal
