// SPDX-License-Identifier: Apache-2.0
#include "idl/internal/structure_sizes.hpp"

#include <algorithm>

#include "idl/canonical.hpp"
#include "idl/limits.hpp"

namespace armature::idl::internal {
namespace {

Size bounded(Size size) {
  size.canonical = std::min(size.canonical, 2 * kLongestCanonical);
  size.wire = std::min(size.wire, 2 * kLargestBody);
  return size;
}

std::size_t wire_size(Basic basic) {
  switch (basic) {
    case Basic::kBool:
    case Basic::kChar:
    case Basic::kByte:
      return 1;
    case Basic::kShort:
    case Basic::kUnsignedShort:
      return 2;
    case Basic::kLong:
    case Basic::kUnsignedLong:
    case Basic::kDouble:
      return 8;
    default:
      return 4;
  }
}

}  // namespace

Size StructureSizes::of(const Structure& structure) {
  if (const auto known = known_.find(&structure); known != known_.end()) return known->second;
  if (std::find(open_.begin(), open_.end(), &structure) != open_.end()) {
    report_circle(structure);
    return {};
  }
  if (open_.size() >= kDeepestNesting) {
    diagnostics_.error(open_.front()->where, "'" + open_.front()->name + "' has more than " +
                                                 std::to_string(kDeepestNesting) +
                                                 " levels of nested structs");
    return {};
  }
  open_.push_back(&structure);
  const std::size_t errors = diagnostics_.error_count();
  Size size = of(structure.members);
  size.canonical += structure.name.size() + std::string_view("struct {}").size();
  size.depth += 1;
  open_.pop_back();
  if (diagnostics_.error_count() == errors && size.canonical > kLongestCanonical) {
    diagnostics_.error(structure.where, "'" + structure.name +
                                            "', with its structs written out, has more than " +
                                            std::to_string(kLongestCanonical) + " characters");
  }
  return known_[&structure] = bounded(size);
}

Size StructureSizes::of(const Type& type) {
  Size size{name_of(type.basic).size(), wire_size(type.basic), 0};
  if (type.basic == Basic::kStruct) {
    const Structure* structure = program_.find_struct(type.name);
    size = structure == nullptr ? Size{} : of(*structure);
  }
  if (type.basic == Basic::kEnum) {
    const Enumeration* enumeration = program_.find_enum(type.name);
    size = enumeration == nullptr
               ? Size{}
               : Size{canonical(*enumeration).size(), wire_size(enumeration->underlying), 0};
  }
  if (type.is_array()) size.canonical += std::string_view("Array<,16777216>").size();
  if (type.form == Type::Form::kCounted) size.wire = 4;
  if (type.form == Type::Form::kFixed) size.wire *= type.count;
  return bounded(size);
}

Size StructureSizes::of(const std::vector<Field>& fields) {
  Size all;
  for (const Field& field : fields) {
    const Size one = of(field.type);
    all.canonical += one.canonical + 1;
    all.wire += one.wire;
    all.depth = std::max(all.depth, one.depth);
    all = bounded(all);
  }
  return all;
}

void StructureSizes::report_circle(const Structure& structure) {
  std::string way;
  const auto begin = std::find(open_.begin(), open_.end(), &structure);
  for (auto each = begin; each != open_.end(); ++each) way += (*each)->name + " -> ";
  diagnostics_.error(structure.where,
                     "struct '" + structure.name + "' contains itself: " + way + structure.name,
                     "refer to the other one by a number or name instead");
}

}  // namespace armature::idl::internal
