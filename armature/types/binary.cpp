// SPDX-License-Identifier: Apache-2.0
#include <bit>
#include <cstring>

#include "armature/types/elements.hpp"
#include "armature/types/enum.hpp"

namespace armature::types {
namespace {

static_assert(std::endian::native == std::endian::little, "the binary form is little-endian");

using Count = std::uint32_t;

std::byte* put(std::byte* to, const void* from, std::size_t size) {
  if (size > 0) std::memcpy(to, from, size);
  return to + size;
}

std::byte* put_count(std::byte* to, std::size_t count) {
  const Count written = static_cast<Count>(count);
  return put(to, &written, sizeof(written));
}

std::byte* put_value(std::byte* to, const Type& type, const void* value);

std::byte* put_list(std::byte* to, const Type& list, const void* value) {
  const std::size_t count = element_count(list, value);
  if (list.kind == Kind::kVector) to = put_count(to, count);
  const Type& element = *list.element;
  const std::byte* first = elements(list, value);
  if (is_scalar(element)) return put(to, first, count * element.size);
  for (std::size_t i = 0; i < count; ++i) to = put_value(to, element, first + i * element.size);
  return to;
}

std::byte* put_value(std::byte* to, const Type& type, const void* value) {
  if (is_scalar(type)) return put(to, value, type.size);
  if (is_list(type)) return put_list(to, type, value);
  if (is_text(type)) {
    const std::string_view text = type.text(value);
    return put(put_count(to, text.size()), text.data(), text.size());
  }
  for (const Field& field : type.fields) {
    to = put_value(to, *field.type, at_offset(value, field.offset));
  }
  return to;
}

std::size_t encoded_list_size(const Type& list, const void* value) {
  const std::size_t count = element_count(list, value);
  const Type& element = *list.element;
  std::size_t size = list.kind == Kind::kVector ? sizeof(Count) : 0;
  if (is_scalar(element)) return size + count * element.size;
  const std::byte* first = elements(list, value);
  for (std::size_t i = 0; i < count; ++i) size += encoded_size(element, first + i * element.size);
  return size;
}

/// The fewest bytes that a value of this type takes, at least 1.
std::size_t least_size(const Type& type) {
  if (is_scalar(type)) return type.size;
  if (type.kind == Kind::kArray) return type.count * least_size(*type.element);
  if (type.kind != Kind::kStruct) return sizeof(Count);
  std::size_t size = 0;
  for (const Field& field : type.fields) size += least_size(*field.type);
  return size;
}

/// Reads a value, or only checks that it could be read if the value is nullptr.
class Reader {
 public:
  Reader(const std::byte* from, std::size_t size) : from_(from), size_(size) {}

  bool read(const Type& type, void* value) {
    if (is_scalar(type)) return read_scalars(type, 1, value);
    if (is_list(type)) return read_list(type, value);
    if (is_text(type)) return read_text(type, value);
    for (const Field& field : type.fields) {
      if (!read(*field.type, at_offset(value, field.offset))) return false;
    }
    return true;
  }

  std::size_t used() const { return used_; }
  const std::string& problem() const { return problem_; }

 private:
  std::size_t remaining() const { return size_ - used_; }

  bool fail(const Type& type, const std::string& what) {
    problem_ = type.name + " at byte " + std::to_string(used_) + " " + what;
    return false;
  }

  bool require(const Type& type, std::size_t size) {
    if (size <= remaining()) return true;
    return fail(type, "needs " + std::to_string(size) + " bytes, but only " +
                          std::to_string(remaining()) + " remain");
  }

  bool read_scalars(const Type& scalar, std::size_t count, void* to) {
    const std::size_t size = count * scalar.size;
    if (!require(scalar, size)) return false;
    if (scalar.kind == Kind::kBool && !check_bools(scalar, size)) return false;
    if (scalar.kind == Kind::kEnum && !check_enumerators(scalar, count)) return false;
    if (to != nullptr && size > 0) std::memcpy(to, from_ + used_, size);
    used_ += size;
    return true;
  }

  bool check_bools(const Type& scalar, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const int found = std::to_integer<int>(from_[used_ + i]);
      if (found > 1) return fail(scalar, "is 0 or 1, but " + std::to_string(found) + " was found");
    }
    return true;
  }

  bool check_enumerators(const Type& scalar, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const std::byte* const found = from_ + used_ + i * scalar.size;
      if (is_enumerator(scalar, found)) continue;
      return fail(scalar, "is " + enumerator_list(scalar) + ", but " +
                              to_text(*scalar.underlying, found) + " was found");
    }
    return true;
  }

  bool read_count(const Type& type, std::size_t least_element_size, std::size_t& count) {
    Count found = 0;
    if (!require(type, sizeof(found))) return false;
    std::memcpy(&found, from_ + used_, sizeof(found));
    if (found > (remaining() - sizeof(found)) / least_element_size) {
      return fail(type, "announces " + std::to_string(found) + " elements, but only " +
                            std::to_string(remaining() - sizeof(found)) + " bytes remain");
    }
    used_ += sizeof(found);
    count = found;
    return true;
  }

  bool read_list(const Type& list, void* value) {
    const Type& element = *list.element;
    std::size_t count = list.count;
    if (list.kind == Kind::kVector) {
      if (!read_count(list, least_size(element), count)) return false;
      if (value != nullptr) list.vector_resize(value, count);
    }
    void* const first = value == nullptr ? nullptr : elements(list, value);
    if (is_scalar(element)) return read_scalars(element, count, first);
    for (std::size_t i = 0; i < count; ++i) {
      if (!read(element, at_offset(first, i * element.size))) return false;
    }
    return true;
  }

  bool read_text(const Type& type, void* value) {
    std::size_t count = 0;
    if (!read_count(type, 1, count)) return false;
    if (type.kind == Kind::kFixedText && count > type.count) {
      return fail(type, "is too short for " + std::to_string(count) + " bytes");
    }
    const char* const text = reinterpret_cast<const char*>(from_ + used_);
    if (value != nullptr) type.set_text(value, {text, count});
    used_ += count;
    return true;
  }

  const std::byte* from_;
  std::size_t size_;
  std::size_t used_ = 0;
  std::string problem_;
};

}  // namespace

std::size_t encoded_size(const Type& type, const void* value) {
  if (is_scalar(type)) return type.size;
  if (is_list(type)) return encoded_list_size(type, value);
  if (is_text(type)) return sizeof(Count) + type.text(value).size();
  std::size_t size = 0;
  for (const Field& field : type.fields) {
    size += encoded_size(*field.type, at_offset(value, field.offset));
  }
  return size;
}

std::size_t encode_to(const Type& type, const void* value, std::byte* to) {
  return static_cast<std::size_t>(put_value(to, type, value) - to);
}

void encode(const Type& type, const void* value, std::vector<std::byte>& to) {
  const std::size_t before = to.size();
  to.resize(before + encoded_size(type, value));
  encode_to(type, value, to.data() + before);
}

base::Result<std::size_t> decode(const Type& type, const std::byte* from, std::size_t size,
                                 void* value) {
  Reader check(from, size);
  if (!check.read(type, nullptr)) {
    return base::Error{"cannot decode " + type.name + ": " + check.problem()};
  }
  Reader reader(from, size);
  reader.read(type, value);
  return reader.used();
}

}  // namespace armature::types
