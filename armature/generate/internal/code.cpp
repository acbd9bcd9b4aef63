// SPDX-License-Identifier: Apache-2.0
#include "armature/generate/internal/code.hpp"

#include <cstddef>

namespace armature::generate::internal {
namespace {

constexpr std::size_t kColumns = 100;

/// The end of a text in quotes that begins at `at`.
std::size_t end_of_quotes(std::string_view text, std::size_t at) {
  for (std::size_t i = at + 1; i < text.size(); ++i) {
    if (text[i] == '\\') {
      ++i;
    } else if (text[i] == '"') {
      return i;
    }
  }
  return text.size() - 1;
}

/// Places behind which a line may end: commas within braces, if there are braces, else within
/// parentheses.
std::vector<std::size_t> breaks_in(std::string_view text) {
  std::vector<std::size_t> in_braces;
  std::vector<std::size_t> in_parentheses;
  int braces = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') i = end_of_quotes(text, i);
    if (text[i] == '{') ++braces;
    if (text[i] == '}') --braces;
    if (text[i] == ',') (braces > 0 ? in_braces : in_parentheses).push_back(i);
  }
  return in_braces.empty() ? in_parentheses : in_braces;
}

}  // namespace

void Code::line(std::string_view text) { broken({}, text); }

void Code::chain(const std::vector<std::string>& calls) {
  for (std::size_t i = 0; i < calls.size(); ++i) {
    const bool last = i + 1 == calls.size();
    broken(i == 0 ? "  " : "      ", calls[i] + (last ? ";" : ""));
  }
}

/// As many items to a line as it takes.
void Code::broken(std::string_view indent, std::string_view text) {
  std::string line = std::string(indent);
  if (indent.size() + text.size() <= kColumns) {
    text_ += line.append(text) + '\n';
    return;
  }
  std::size_t from = 0;
  std::vector<std::size_t> ends = breaks_in(text);
  ends.push_back(text.size() - 1);
  for (const std::size_t end : ends) {
    const std::string_view item = text.substr(from, end + 1 - from);
    if (from > 0 && line.size() + item.size() > kColumns) {
      text_ += line + '\n';
      line = std::string(indent) + "    ";
      line.append(item.substr(item.find_first_not_of(' ')));
    } else {
      line.append(item);
    }
    from = end + 1;
  }
  text_ += line + '\n';
}

}  // namespace armature::generate::internal
