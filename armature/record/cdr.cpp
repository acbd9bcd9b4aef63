// SPDX-License-Identifier: Apache-2.0
#include "armature/record/cdr.hpp"

#include <cstring>

#include "armature/types/elements.hpp"

namespace armature::record {
namespace {

using types::Kind;
using types::Type;

/// CDR, little-endian, that aligns each number to its own size.
constexpr std::string_view kCdrHead("\x00\x01\x00\x00", 4);

class CdrWriter {
 public:
  std::string whole(const Type& type, const void* value) {
    put(type, value);
    return std::string(kCdrHead) + bytes_;
  }

 private:
  void put(const Type& type, const void* value) {
    if (types::is_text(type)) return put_text(type.text(value));
    if (types::is_list(type)) return put_list(type, value);
    if (type.kind == Kind::kEnum) return put(*type.underlying, value);
    if (type.kind != Kind::kStruct) return put_number(value, type.size);
    for (const types::Field& field : type.fields) {
      put(*field.type, types::at_offset(value, field.offset));
    }
  }

  void put_number(const void* number, std::size_t size) {
    bytes_.resize((bytes_.size() + size - 1) / size * size);
    bytes_.append(static_cast<const char*>(number), size);
  }

  void put_count(std::size_t count) {
    const auto number = static_cast<std::uint32_t>(count);
    put_number(&number, sizeof number);
  }

  void put_text(std::string_view text) {
    put_count(text.size() + 1);
    bytes_ += text;
    bytes_ += '\0';
  }

  void put_list(const Type& list, const void* value) {
    const std::size_t count = types::element_count(list, value);
    const std::byte* const first = types::elements(list, value);
    if (list.kind == Kind::kVector) put_count(count);
    for (std::size_t i = 0; i < count; ++i) put(*list.element, first + i * list.element->size);
  }

  std::string bytes_;
};

}  // namespace

std::string to_cdr(const Type& type, const void* value) { return CdrWriter().whole(type, value); }

}  // namespace armature::record
