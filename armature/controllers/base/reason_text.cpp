// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/base/reason_text.hpp"

#include <charconv>

namespace armature::controllers {

component::Reason& append_number(component::Reason& reason, double number) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, number).ptr;
  return reason.append(std::string_view(digits, static_cast<std::size_t>(end - digits)));
}

}  // namespace armature::controllers
