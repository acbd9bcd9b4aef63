// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "armature/types/elements.hpp"

namespace armature::types {
namespace {

bool same_list_shape(const Type& list, const void* a, const void* b) {
  const std::size_t count = element_count(list, a);
  if (element_count(list, b) != count) return false;
  const Type& element = *list.element;
  if (element.fixed_size()) return true;
  const std::byte* of_a = elements(list, a);
  const std::byte* of_b = elements(list, b);
  for (std::size_t i = 0; i < count; ++i) {
    if (!same_shape(element, of_a + i * element.size, of_b + i * element.size)) return false;
  }
  return true;
}

}  // namespace

bool same_shape(const Type& type, const void* a, const void* b) {
  if (type.fixed_size()) return true;
  if (is_text(type)) return type.text(a).size() == type.text(b).size();
  if (is_list(type)) return same_list_shape(type, a, b);
  return std::all_of(type.fields.begin(), type.fields.end(), [&](const Field& field) {
    return same_shape(*field.type, at_offset(a, field.offset), at_offset(b, field.offset));
  });
}

namespace internal {

void visit_leaves(const Type& type, const void* value, std::string& path, VisitLeaf visit,
                  void* visitor) {
  const std::size_t outside = path.size();
  if (is_list(type)) {
    const std::size_t count = element_count(type, value);
    const std::byte* first = elements(type, value);
    for (std::size_t i = 0; i < count; ++i) {
      path += '[' + std::to_string(i) + ']';
      visit_leaves(*type.element, first + i * type.element->size, path, visit, visitor);
      path.resize(outside);
    }
  } else if (type.kind == Kind::kStruct) {
    for (const Field& field : type.fields) {
      if (!path.empty()) path += '.';
      path += field.name;
      visit_leaves(*field.type, at_offset(value, field.offset), path, visit, visitor);
      path.resize(outside);
    }
  } else {
    visit(path, type, value, visitor);
  }
}

}  // namespace internal
}  // namespace armature::types
