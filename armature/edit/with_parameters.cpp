// SPDX-License-Identifier: Apache-2.0
#include "armature/edit/internal/with_parameters.hpp"

#include <cstddef>

#include "armature/document/value_tree.hpp"

namespace armature::edit::internal {

std::string with_parameters(std::string text, const std::vector<document::Property>& parameters) {
  for (std::size_t at = text.find("${"); at != text.npos; at = text.find("${", at + 1)) {
    const std::size_t end = text.find('}', at);
    if (end == text.npos) return text;
    const auto* found = document::find(parameters, text.substr(at + 2, end - at - 2));
    if (found != nullptr) text.replace(at, end + 1 - at, found->value.text);
  }
  return text;
}

}  // namespace armature::edit::internal
