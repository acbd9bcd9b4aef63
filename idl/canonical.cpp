// SPDX-License-Identifier: Apache-2.0
#include "idl/canonical.hpp"

#include <algorithm>

#include "armature/base/hash.hpp"
#include "idl/number.hpp"

namespace armature::idl {
namespace {

std::string types_of(const Program& program, const std::vector<Field>& fields) {
  std::string text;
  for (const Field& field : fields) {
    if (&field != &fields.front()) text += ',';
    text += canonical(program, field.type);
  }
  return text;
}

std::string single(const Program& program, const Type& type) {
  if (type.basic == Basic::kStruct) return canonical(program, *program.find_struct(type.name));
  if (type.basic == Basic::kEnum) return canonical(*program.find_enum(type.name));
  return std::string(name_of(type.basic));
}

}  // namespace

std::string canonical(const Enumeration& enumeration) {
  std::string text =
      "enum " + enumeration.name + ":" + std::string(name_of(enumeration.underlying)) + "{";
  for (const Enumerator& each : enumeration.enumerators) {
    if (&each != &enumeration.enumerators.front()) text += ',';
    text += each.name + "=" + to_text(each.value);
  }
  return text + "}";
}

std::string canonical(const Program& program, const Type& type) {
  std::string text = single(program, type);
  if (type.form == Type::Form::kSingle) return text;
  if (type.form == Type::Form::kFixed) text += "," + std::to_string(type.count);
  return "Array<" + text + ">";
}

std::string canonical(const Program& program, const Structure& structure) {
  return (structure.is_event ? "event " : "struct ") + structure.name + "{" +
         types_of(program, structure.members) + "}";
}

std::string canonical(const Program& program, const Operation& operation) {
  return canonical(program, operation.result) + " " + operation.name + "(" +
         types_of(program, operation.parameters) + ")";
}

std::uint32_t number_of(std::string_view canonical) { return base::fnv1a(canonical); }

std::vector<std::string> declarations(const Program& program, const Interface& interface) {
  std::vector<std::string> all;
  for (const Operation& operation : interface.operations) {
    all.push_back(canonical(program, operation));
  }
  for (const EventName& event : interface.events) {
    all.push_back(canonical(program, *program.find_event(event.name)));
  }
  std::sort(all.begin(), all.end());
  return all;
}

std::uint32_t digest(const Program& program, const Interface& interface) {
  std::uint32_t hash = base::fnv1a("");
  const std::vector<std::string> all = declarations(program, interface);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i > 0) hash = base::fnv1a(";", hash);
    hash = base::fnv1a(all[i], hash);
  }
  return hash;
}

}  // namespace armature::idl
