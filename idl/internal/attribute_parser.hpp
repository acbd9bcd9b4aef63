// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "idl/internal/token_reader.hpp"

namespace armature::idl::internal {

/// What stands in brackets before a member, a parameter, an operation or an interface's event.
struct Attributes {
  std::string unit;
  std::optional<Range> range;
  std::optional<Access> access;
  std::optional<std::uint8_t> priority;
  const Token* later = nullptr;         ///< where `later` is, if it is there
  const Token* of_field = nullptr;      ///< the first that only a member or parameter has
  const Token* of_operation = nullptr;  ///< the first that only an operation has
  const Token* of_message = nullptr;    ///< the first that an operation or an event has
};

/// Reads any number of `[unit("rad"), range(0, 1)]`. Throws Mistake where it cannot go on.
Attributes parse_attributes(TokenReader& reader);

}  // namespace armature::idl::internal
