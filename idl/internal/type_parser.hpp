// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "idl/internal/token_reader.hpp"

namespace armature::idl::internal {

/// Reads a type; of a word that is none it says what was meant, and goes on as if it were one.
class TypeParser {
 public:
  explicit TypeParser(TokenReader& reader);

  Type parse(const std::string& of_what);
  Type parse_or_void(const std::string& of_what);
  /// The integers as which an enum is sent.
  Basic parse_underlying(const std::string& of_what);

 private:
  Type array();
  Type single(const std::string& of_what);
  Basic unsigned_type();
  Type unknown(const std::string& of_what);
  std::uint32_t element_count();

  TokenReader& reader_;
  std::vector<std::string> structs_;  ///< that the file defines
  std::vector<std::string> enums_;    ///< the same
};

}  // namespace armature::idl::internal
