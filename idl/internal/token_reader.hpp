// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "idl/lexer.hpp"
#include "idl/model.hpp"

namespace armature::idl::internal {

/// Thrown behind a mistake that was reported: the parser goes on at the next place it knows.
struct Mistake {};

/// Walks through the tokens of a source and reports where they are not what was expected.
class TokenReader {
 public:
  TokenReader(const Source& source, base::Diagnostics& diagnostics);

  const Token& now() const { return tokens_[at_]; }
  const Token& ahead(std::size_t count) const;
  const std::vector<Token>& all() const { return tokens_; }
  std::size_t position() const { return at_; }
  bool at_end() const { return now().kind == Token::Kind::kEnd; }
  bool is(std::string_view text) const { return is(now(), text); }
  static bool is(const Token& token, std::string_view text);

  /// Steps over the token; never beyond the last.
  const Token& take();
  /// Steps over it if it is `text`.
  bool take_if(std::string_view text);
  /// Steps over `sign`, which `after` is to be followed by. Throws Mistake.
  void expect(std::string_view sign, const std::string& after);
  /// A name that somebody chose, of `what`. Throws Mistake.
  const Token& expect_name(const std::string& what);
  /// Of something in a definition, where `event`, `interface` and `import` are names, too.
  const Token& expect_inner_name(const std::string& what);

  /// The documentation of the tokens from `begin` until `end`.
  Doc doc_between(std::size_t begin, std::size_t end) const;
  base::Location where(const Token& token) const { return source_.location(token.offset); }
  /// `'name'`, or `the end of the file`.
  static std::string shown(const Token& token);

  void error(const Token& token, std::string message, base::Hint hint = {});
  /// Reports at a token and throws Mistake.
  [[noreturn]] void fail(const Token& token, std::string message, base::Hint hint = {});
  bool gave_up() const;

 private:
  const Source& source_;
  base::Diagnostics& diagnostics_;
  std::vector<Token> tokens_;
  std::size_t at_ = 0;
};

bool is_word_of_the_language(std::string_view word);
bool begins_type(std::string_view word);

}  // namespace armature::idl::internal
