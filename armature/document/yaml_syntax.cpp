// SPDX-License-Identifier: Apache-2.0
#include "armature/document/internal/yaml_syntax.hpp"

#include <algorithm>
#include <vector>

namespace armature::document {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

/// Follows brackets and quotes through a text, as far as its first mistake.
class BracketScanner {
 public:
  explicit BracketScanner(std::string_view text) : text_(text) {}

  std::optional<Unclosed> scan() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '#' && (at_ == 0 || is_blank(text_[at_ - 1]) || text_[at_ - 1] == '\n')) {
        at_ = std::min(text_.find('\n', at_), text_.size());
      } else if ((c == '"' || c == '\'') && begins_node()) {
        const std::size_t begin = at_;
        if (!skip_quoted(c)) return Unclosed{c, begin};
      } else if ((c == '[' || c == '{') && (!open_.empty() || begins_node())) {
        open_.push_back({c, at_++});
      } else if ((c == ']' || c == '}') && !open_.empty()) {
        if (open_.back().what != (c == ']' ? '[' : '{')) return open_.back();
        open_.pop_back();
        ++at_;
      } else {
        ++at_;
      }
    }
    if (open_.empty()) return std::nullopt;
    return open_.back();
  }

 private:
  /// True where a value or key begins, not in the middle of an unquoted text.
  bool begins_node() const {
    std::size_t before = at_;
    while (before > 0 && is_blank(text_[before - 1])) --before;
    if (before == 0) return true;
    const char c = text_[before - 1];
    constexpr std::string_view kInFlow = "[{,:\n";
    if (kInFlow.find(c) != std::string_view::npos) return true;
    const bool spaced = before < at_;
    return spaced && (c == '-' || c == '?' || ends_tag(before));
  }

  /// True if the word that ends at `end` is a tag or an anchor.
  bool ends_tag(std::size_t end) const {
    std::size_t begin = end;
    while (begin > 0 && !is_blank(text_[begin - 1]) && text_[begin - 1] != '\n') --begin;
    return begin < end && (text_[begin] == '!' || text_[begin] == '&');
  }

  bool skip_quoted(char quote) {
    for (++at_; at_ < text_.size(); ++at_) {
      if (quote == '"' && text_[at_] == '\\') {
        ++at_;
      } else if (text_[at_] == quote) {
        const bool doubled = quote == '\'' && text_.substr(at_ + 1, 1) == "'";
        ++at_;
        if (!doubled) return true;
      }
    }
    return false;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::vector<Unclosed> open_;
};

}  // namespace

std::optional<Unclosed> find_unclosed(std::string_view text) { return BracketScanner(text).scan(); }

std::string hint_for_line(std::string_view line) {
  const std::string_view indentation = line.substr(0, line.find_first_not_of(" \t"));
  if (indentation.find('\t') != std::string_view::npos) return "indent with spaces, not with tabs";
  const auto has = [&](std::string_view part) { return line.find(part) != std::string_view::npos; };
  if (has("{i") || has("..") || has("${")) {
    return "inside [ ] and { }, put text that contains braces in quotes";
  }
  return {};
}

}  // namespace armature::document
