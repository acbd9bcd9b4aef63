// SPDX-License-Identifier: Apache-2.0
#include "idl/internal/token_reader.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "idl/limits.hpp"

namespace armature::idl::internal {
namespace {

constexpr std::string_view kDefinitions[] = {"struct", "event", "interface", "import"};
constexpr std::string_view kTypes[] = {"struct", "void",   "bool",    "byte",  "char",
                                       "short",  "int",    "long",    "float", "Array",
                                       "double", "String", "unsigned"};

template <std::size_t N>
bool is_one_of(const std::string_view (&words)[N], std::string_view word) {
  return std::find(std::begin(words), std::end(words), word) != std::end(words);
}

}  // namespace

bool is_word_of_the_language(std::string_view word) {
  return is_one_of(kDefinitions, word) || is_one_of(kTypes, word);
}

bool begins_type(std::string_view word) { return is_one_of(kTypes, word); }

TokenReader::TokenReader(const Source& source, base::Diagnostics& diagnostics)
    : source_(source), diagnostics_(diagnostics), tokens_(tokenize(source, diagnostics)) {}

bool TokenReader::is(const Token& token, std::string_view text) {
  const bool spelled = token.kind == Token::Kind::kWord || token.kind == Token::Kind::kSign;
  return spelled && token.text == text;
}

const Token& TokenReader::take() {
  const Token& taken = now();
  if (!at_end()) ++at_;
  return taken;
}

bool TokenReader::take_if(std::string_view text) {
  if (!is(text)) return false;
  take();
  return true;
}

void TokenReader::expect(std::string_view sign, const std::string& after) {
  if (take_if(sign)) return;
  const std::string message =
      "expected '" + std::string(sign) + "' after " + after + ", found " + shown(now());
  // What is missing belongs behind what is there, often at the end of the line before.
  if (sign == ";" && at_ > 0) {
    diagnostics_.error(source_.location(tokens_[at_ - 1].end), message);
    throw Mistake{};
  }
  fail(now(), message);
}

const Token& TokenReader::expect_name(const std::string& what) {
  if (now().kind != Token::Kind::kWord) {
    fail(now(), "expected the name of " + what + ", found " + shown(now()),
         is("{") ? "is a '}' missing before it?" : "");
  }
  if (is_word_of_the_language(now().text)) {
    fail(now(),
         shown(now()) + " is a word of the language; expected the name of " + what + " here");
  }
  return take();
}

const Token& TokenReader::expect_inner_name(const std::string& what) {
  if (now().kind == Token::Kind::kWord && !begins_type(now().text)) return take();
  return expect_name(what);
}

const Token& TokenReader::ahead(std::size_t count) const {
  return tokens_[std::min(at_ + count, tokens_.size() - 1)];
}

Doc TokenReader::doc_between(std::size_t begin, std::size_t end) const {
  Doc doc;
  for (std::size_t i = begin; i < std::min(end, tokens_.size()); ++i) {
    doc.insert(doc.end(), tokens_[i].doc.begin(), tokens_[i].doc.end());
    if (!tokens_[i].doc_after.empty()) doc.push_back(tokens_[i].doc_after);
  }
  return doc;
}

std::string TokenReader::shown(const Token& token) {
  if (token.kind == Token::Kind::kEnd) return "the end of the file";
  if (token.kind == Token::Kind::kText) return "\"" + std::string(token.text) + "\"";
  return "'" + std::string(token.text) + "'";
}

void TokenReader::error(const Token& token, std::string message, base::Hint hint) {
  diagnostics_.error(where(token), std::move(message), std::move(hint));
}

void TokenReader::fail(const Token& token, std::string message, base::Hint hint) {
  error(token, std::move(message), std::move(hint));
  throw Mistake{};
}

bool TokenReader::gave_up() const { return diagnostics_.error_count() >= kMostErrors; }

}  // namespace armature::idl::internal
