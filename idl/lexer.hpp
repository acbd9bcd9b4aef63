// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "idl/source.hpp"

namespace armature::idl {

/// The smallest part of the language with a meaning, and the documentation beside it.
struct Token {
  enum class Kind { kWord, kNumber, kText, kSign, kEnd };

  Kind kind = Kind::kEnd;
  std::string_view text;         ///< as in the source; without its quotes if it is a text
  std::size_t offset = 0;        ///< of its first byte
  std::size_t end = 0;           ///< of the byte behind it
  std::vector<std::string> doc;  ///< the lines of `///` before it
  std::string doc_after;         ///< `///<` behind it
};

/// Divides a source into tokens, of which the last is always kEnd. They refer to `source`. What is
/// no token is reported and left out.
std::vector<Token> tokenize(const Source& source, base::Diagnostics& diagnostics);

}  // namespace armature::idl
