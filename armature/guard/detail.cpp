// SPDX-License-Identifier: Apache-2.0
#include <charconv>

#include "armature/guard/internal/watch.hpp"

namespace armature::guard {

Detail number(std::string_view before, std::size_t value, std::string_view after) {
  char digits[24] = "";
  const char* const end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  Detail detail(before);
  detail.append({digits, static_cast<std::size_t>(end - digits)}).append(after);
  return detail;
}

Detail bytes(std::size_t count) { return number("", count, " bytes"); }

Detail file(int descriptor) { return number("file ", static_cast<std::size_t>(descriptor)); }

Detail file(int descriptor, std::size_t count) {
  return file(descriptor).append(", ").append(bytes(count));
}

Detail path(const char* name) {
  return name == nullptr ? Detail() : Detail(std::string_view(name));
}

}  // namespace armature::guard
