// SPDX-License-Identifier: Apache-2.0
#include "armature/component/operations/signature.hpp"

#include <cstddef>

namespace armature::component {

bool Signature::same_as(const Signature& other) const {
  const bool same_result = (result == nullptr) == (other.result == nullptr) &&
                           (result == nullptr || types::same_type(*result, *other.result));
  if (!same_result || arguments.size() != other.arguments.size()) return false;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const Argument& mine = arguments[i];
    const Argument& given = other.arguments[i];
    if (mine.by_reference != given.by_reference) return false;
    if (!types::same_type(*mine.type, *given.type)) return false;
  }
  return true;
}

std::string Signature::text() const {
  std::string text = (result == nullptr ? "void" : result->name) + "(";
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (i > 0) text += ", ";
    const Argument& argument = arguments[i];
    text += argument.by_reference ? "const " + argument.type->name + "&" : argument.type->name;
    if (!argument.name.empty()) text += " " + std::string(argument.name);
  }
  return text + ")";
}

}  // namespace armature::component
