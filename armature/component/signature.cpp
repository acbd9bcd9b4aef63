// SPDX-License-Identifier: Apache-2.0
#include "armature/component/signature.hpp"

#include <cstddef>

namespace armature::component {

bool Signature::same_as(const Signature& other) const {
  const bool same_result = (result == nullptr) == (other.result == nullptr) &&
                           (result == nullptr || types::same_type(*result, *other.result));
  if (!same_result || arguments.size() != other.arguments.size()) return false;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (!types::same_type(*arguments[i].type, *other.arguments[i].type)) return false;
  }
  return true;
}

std::string Signature::text() const {
  std::string text = (result == nullptr ? "void" : result->name) + "(";
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (i > 0) text += ", ";
    text += arguments[i].type->name;
    if (!arguments[i].name.empty()) text += " " + std::string(arguments[i].name);
  }
  return text + ")";
}

}  // namespace armature::component
