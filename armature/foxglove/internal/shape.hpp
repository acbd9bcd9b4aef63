// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "armature/foxglove/internal/json.hpp"
#include "armature/inspect/describe.hpp"

namespace armature::foxglove::internal {

/// What a value is made of, as descriptions tell it by names of types.
struct Shape {
  /// An enumeration is its number.
  enum class Kind { kFloat, kInteger, kBool, kText, kEnumeration, kList, kStruct };

  Kind kind = Kind::kInteger;
  std::string type{};
  std::string name{};                  ///< of a field of a struct
  std::string about{};                 ///< likewise its documentation and unit
  std::optional<std::size_t> count{};  ///< of an array
  std::vector<Shape> members{};        ///< of a struct; of a list its element

  bool has_text() const;
};

/// @param type    as descriptions name it: `vector<double>`
/// @param fields  of all structs that are in it
Shape shape_of(const std::string& type, const std::vector<inspect::FieldDescription>& fields);

/// `ahead of the dock [m]`.
std::string about(const std::string& doc, const std::string& unit);

/// The JSON Schema of values in the form of recordings: a struct is an object, and anything else
/// the member `value` of one.
std::string schema_of(const Shape& shape, const std::string& about);

}  // namespace armature::foxglove::internal
