// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/types/type.hpp"

namespace armature::types::internal {

inline bool is_list(const Type& type) { return type.element != nullptr; }

inline bool is_text(const Type& type) { return type.text != nullptr; }

inline bool is_scalar(const Type& type) {
  return !is_list(type) && !is_text(type) && type.kind != Kind::kStruct;
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

}  // namespace armature::types::internal
