// SPDX-License-Identifier: Apache-2.0
#pragma once

// What walks through values needs: of which sort a type is, and where the parts of a value lie.

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "armature/types/type.hpp"

namespace armature::types {

inline bool is_list(const Type& type) { return type.element != nullptr; }

inline bool is_text(const Type& type) { return type.text != nullptr; }

inline bool is_scalar(const Type& type) {
  return !is_list(type) && !is_text(type) && type.kind != Kind::kStruct;
}

/// Neither an enumeration nor a bool counts as one.
inline bool is_number(const Type& type) {
  return is_scalar(type) && type.kind != Kind::kEnum && type.kind != Kind::kBool;
}

inline std::size_t element_count(const Type& list, const void* value) {
  return list.kind == Kind::kVector ? list.vector_size(value) : list.count;
}

inline std::byte* elements(const Type& list, void* value) {
  return static_cast<std::byte*>(list.kind == Kind::kVector ? list.vector_data(value) : value);
}

inline const std::byte* elements(const Type& list, const void* value) {
  return elements(list, const_cast<void*>(value));
}

inline const void* at_offset(const void* value, std::size_t offset) {
  return static_cast<const std::byte*>(value) + offset;
}

/// No value stays no value: readers check their input with it before they write.
inline void* at_offset(void* value, std::size_t offset) {
  return value == nullptr ? nullptr : static_cast<std::byte*>(value) + offset;
}

/// Of an enumeration: the names of its values, in their order.
std::vector<std::string> enumerator_names(const Type& type);

/// Of an enumeration: `{off=0,on=1}`.
std::string enumerator_values(const Type& type);

/// Calls `code` with `std::type_identity` of the C++ type of a scalar, and returns what it returns;
/// a default value if `kind` is none; an enumeration is asked for its `underlying` type.
template <typename Code>
auto with_scalar(Kind kind, Code&& code) {
  switch (kind) {
    case Kind::kBool:
      return code(std::type_identity<bool>{});
    case Kind::kInt8:
      return code(std::type_identity<std::int8_t>{});
    case Kind::kUint8:
      return code(std::type_identity<std::uint8_t>{});
    case Kind::kInt16:
      return code(std::type_identity<std::int16_t>{});
    case Kind::kUint16:
      return code(std::type_identity<std::uint16_t>{});
    case Kind::kInt32:
      return code(std::type_identity<std::int32_t>{});
    case Kind::kUint32:
      return code(std::type_identity<std::uint32_t>{});
    case Kind::kInt64:
      return code(std::type_identity<std::int64_t>{});
    case Kind::kUint64:
      return code(std::type_identity<std::uint64_t>{});
    case Kind::kFloat:
      return code(std::type_identity<float>{});
    case Kind::kDouble:
      return code(std::type_identity<double>{});
    default:
      return decltype(code(std::type_identity<bool>{}))();
  }
}

/// The number at `value` as a floating one of type `to`, at `result`.
/// @rt nonblocking, no allocation
inline void convert_number(const Type& from, const void* value, const Type& to,
                           void* result) noexcept {
  const double number = with_scalar(from.kind, [value](auto type) {
    return static_cast<double>(*static_cast<const typename decltype(type)::type*>(value));
  });
  if (to.kind == Kind::kFloat) {
    *static_cast<float*>(result) = static_cast<float>(number);
  } else {
    *static_cast<double*>(result) = number;
  }
}

}  // namespace armature::types
