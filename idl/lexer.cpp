// SPDX-License-Identifier: Apache-2.0
#include "idl/lexer.hpp"

#include <cctype>
#include <utility>

#include "armature/base/utf8.hpp"
#include "idl/limits.hpp"

namespace armature::idl {
namespace {

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool begins_word(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool continues_word(char c) { return begins_word(c) || is_digit(c); }
bool is_control(char c) { return static_cast<unsigned char>(c) < ' ' || c == 0x7f; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (is_control(text.back()) || text.back() == ' ')) text.remove_suffix(1);
  return text;
}

class Lexer {
 public:
  Lexer(const Source& source, base::Diagnostics& diagnostics)
      : source_(source), text_(source.text()), diagnostics_(diagnostics) {}

  std::vector<Token> run() {
    while (true) {
      skip_blanks_and_comments();
      if (at_ == text_.size() || diagnostics_.error_count() >= kMostErrors) break;
      take_token();
    }
    add(Token::Kind::kEnd, text_.size(), text_.size(), {});
    return std::move(tokens_);
  }

 private:
  char peek(std::size_t ahead = 0) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
  }
  bool follows(std::string_view what) const { return text_.substr(at_).starts_with(what); }

  void skip_blanks_and_comments() {
    while (at_ < text_.size()) {
      if (follows("//")) {
        take_line_comment();
      } else if (follows("/*")) {
        skip_block_comment();
      } else if (std::isspace(static_cast<unsigned char>(peek())) != 0) {
        ++at_;
      } else {
        return;
      }
    }
  }

  void take_line_comment() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    std::string_view comment = text_.substr(at_, end - at_);
    check_comment(comment);
    at_ = end;
    if (!comment.starts_with("///") || comment.starts_with("////")) return;
    comment.remove_prefix(3);
    if (comment.starts_with('<')) return take_doc_after(comment.substr(1));
    if (comment.starts_with(' ')) comment.remove_prefix(1);
    doc_.emplace_back(trimmed(comment));
  }

  /// Carriage returns are part of a line's end; a tab is as good as a blank.
  void check_comment(std::string_view comment) {
    for (std::size_t i = 0; i < comment.size(); ++i) {
      const char c = comment[i];
      const bool ends_line = c == '\r' && i + 1 == comment.size();
      if (!is_control(c) || c == '\t' || ends_line) continue;
      error(at_ + i, "a control character is in a comment", "remove it");
      return;
    }
  }

  void take_doc_after(std::string_view comment) {
    if (tokens_.empty()) return;
    while (comment.starts_with(' ')) comment.remove_prefix(1);
    std::string& doc = tokens_.back().doc_after;
    if (!doc.empty()) doc += ' ';
    doc += trimmed(comment);
  }

  void skip_block_comment() {
    const std::size_t end = text_.find("*/", at_ + 2);
    if (end == std::string_view::npos) {
      error(at_, "this comment has no end; expected '*/'", "close it");
      at_ = text_.size();
    } else {
      at_ = end + 2;
    }
  }

  void take_token() {
    const char c = peek();
    if (begins_word(c)) return take_word();
    if (is_digit(c) || ((c == '-' || c == '+' || c == '.') && is_number_behind())) {
      return take_number();
    }
    if (c == '"') return take_text();
    if (std::string_view("{}()<>,;[]:=").find(c) != std::string_view::npos) {
      add(Token::Kind::kSign, at_, at_ + 1, text_.substr(at_, 1));
      ++at_;
      return;
    }
    report_stray();
  }

  bool is_number_behind() const {
    return is_digit(peek(1)) || (peek(1) == '.' && is_digit(peek(2)));
  }

  void take_word() {
    std::size_t end = at_;
    while (end < text_.size() && continues_word(text_[end])) ++end;
    add(Token::Kind::kWord, at_, end, text_.substr(at_, end - at_));
    if (end - at_ > kLongestName) {
      error(at_, "this name has " + std::to_string(end - at_) + " letters; at most " +
                     std::to_string(kLongestName) + " are possible");
    }
    at_ = end;
  }

  /// All that could be meant as one number; the parser says what is wrong with it.
  void take_number() {
    std::size_t end = at_ + 1;
    while (end < text_.size()) {
      const char c = text_[end];
      const bool sign = (c == '-' || c == '+') && std::tolower(text_[end - 1]) == 'e';
      if (!continues_word(c) && c != '.' && !sign) break;
      ++end;
    }
    add(Token::Kind::kNumber, at_, end, text_.substr(at_, end - at_));
    at_ = end;
  }

  void take_text() {
    std::size_t end = at_ + 1;
    while (end < text_.size() && text_[end] != '"' && !is_control(text_[end])) ++end;
    add(Token::Kind::kText, at_, end, text_.substr(at_ + 1, end - at_ - 1));
    if (end < text_.size() && text_[end] == '"') {
      at_ = end + 1;
      tokens_.back().end = at_;
      return;
    }
    error(at_, "this text has no end; expected '\"' in the same line", "close it");
    at_ = end;
  }

  void report_stray() {
    const auto character = base::code_point_at(text_, at_);
    const std::size_t end = character ? character->end : at_ + 1;
    if (is_control(peek())) {
      error(at_, "a control character is not part of the language", "remove it");
    } else {
      error(at_, "'" + std::string(text_.substr(at_, end - at_)) +
                     "' is not part of the language; expected a name, a number, a text in '\"' or "
                     "one of { } ( ) < > [ ] , ; : =");
    }
    at_ = end;
  }

  void add(Token::Kind kind, std::size_t begin, std::size_t end, std::string_view text) {
    tokens_.push_back({kind, text, begin, end, std::exchange(doc_, {}), {}});
  }

  void error(std::size_t offset, std::string message, std::string hint = {}) {
    diagnostics_.error(source_.location(offset), std::move(message), std::move(hint));
  }

  const Source& source_;
  std::string_view text_;
  base::Diagnostics& diagnostics_;
  std::size_t at_ = 0;
  std::vector<std::string> doc_;
  std::vector<Token> tokens_;
};

}  // namespace

std::vector<Token> tokenize(const Source& source, base::Diagnostics& diagnostics) {
  const std::size_t valid = base::valid_utf8_length(source.text());
  if (valid == source.text().size()) return Lexer(source, diagnostics).run();
  diagnostics.error(source.location(valid), "this byte is not valid UTF-8",
                    "save the file as UTF-8");
  return {Token{}};
}

}  // namespace armature::idl
