// SPDX-License-Identifier: Apache-2.0
#include "armature/remote/internal/idl_types.hpp"

#include <cstdint>
#include <vector>

#include "armature/base/fixed_text.hpp"
#include "armature/types/made.hpp"

namespace armature::remote::internal {
namespace {

using Found = base::Result<const types::Type*>;

const types::Type& scalar(idl::Basic basic) {
  switch (basic) {
    case idl::Basic::kBool:
      return types::type_of<bool>();
    case idl::Basic::kChar:
      return types::type_of<std::int8_t>();
    case idl::Basic::kShort:
      return types::type_of<std::int16_t>();
    case idl::Basic::kUnsignedShort:
      return types::type_of<std::uint16_t>();
    case idl::Basic::kInt:
      return types::type_of<std::int32_t>();
    case idl::Basic::kUnsignedInt:
      return types::type_of<std::uint32_t>();
    case idl::Basic::kLong:
      return types::type_of<std::int64_t>();
    case idl::Basic::kUnsignedLong:
      return types::type_of<std::uint64_t>();
    case idl::Basic::kFloat:
      return types::type_of<float>();
    case idl::Basic::kDouble:
      return types::type_of<double>();
    default:
      return types::type_of<std::uint8_t>();
  }
}

/// Of an enumerator; a number above the greatest `long` is none of an enum's.
std::int64_t value_of(const idl::Whole& whole) {
  const auto magnitude = static_cast<std::int64_t>(whole.magnitude);
  return whole.negative ? -magnitude : magnitude;
}

}  // namespace

std::string to_text(const idl::Doc& doc) {
  std::string text;
  for (const std::string& line : doc) text += (text.empty() ? "" : " ") + line;
  return text;
}

Found IdlTypes::of_fixed_size(const idl::Type& type) const {
  const Found element = single(type);
  if (!element || type.form == idl::Type::Form::kSingle) return element;
  if (type.form == idl::Type::Form::kFixed) return types::made_array(*element.value(), type.count);
  return base::Error{idl::to_text(type) + " has no fixed size: give it a number of elements"};
}

Found IdlTypes::of_command(const idl::Type& type) const {
  if (type.form != idl::Type::Form::kCounted) return of_fixed_size(type);
  const Found element = single(type);
  return element ? types::made_vector(*element.value()) : element;
}

Found IdlTypes::of_request(const idl::Type& type) const {
  if (type.basic != idl::Basic::kString || type.form == idl::Type::Form::kFixed) {
    return of_command(type);
  }
  if (type.form == idl::Type::Form::kSingle) return &types::type_of<std::string>();
  return &types::type_of<std::vector<std::string>>();
}

Found IdlTypes::single(const idl::Type& type) const {
  if (type.basic == idl::Basic::kStruct) return structure(type.name);
  if (type.basic == idl::Basic::kEnum) return &enumeration(type.name);
  if (type.basic == idl::Basic::kString) return &types::type_of<base::FixedText<kLongestText>>();
  return &scalar(type.basic);
}

Found IdlTypes::structure(const std::string& name) const {
  std::vector<types::MadeField> fields;
  for (const idl::Field& member : program_.find_struct(name)->members) {
    const Found type = of_fixed_size(member.type);
    if (!type) return base::Error{"struct " + name + ", " + member.name + ": " + type.error()};
    fields.push_back({member.name, type.value(), member.unit, to_text(member.doc)});
  }
  return types::made_struct(name, fields);
}

const types::Type& IdlTypes::enumeration(const std::string& name) const {
  const idl::Enumeration& described = *program_.find_enum(name);
  std::vector<types::Enumerator> enumerators;
  for (const idl::Enumerator& each : described.enumerators) {
    enumerators.push_back({each.name, value_of(each.value)});
  }
  return types::made_enum(name, scalar(described.underlying), enumerators);
}

}  // namespace armature::remote::internal
