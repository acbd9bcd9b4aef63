// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros2/internal/described_type.hpp"

#include <algorithm>
#include <cstring>
#include <string_view>

#include <dds/dds.h>

#include "armature/types/dds_idl.hpp"

namespace armature::ros2::internal {
namespace {

using types::Kind;
using types::Type;

struct Room {
  std::size_t size;
  std::size_t alignment;
};

std::size_t aligned(std::size_t offset, std::size_t alignment) {
  return (offset + alignment - 1) / alignment * alignment;
}

/// Of a C value, as a C compiler lays it out.
Room room_of(const Type& type) {
  switch (type.kind) {
    case Kind::kFixedText:
      return {type.count + 1, 1};
    case Kind::kVector:
      return {sizeof(dds_sequence_t), alignof(dds_sequence_t)};
    case Kind::kArray: {
      const Room one = room_of(*type.element);
      return {one.size * type.count, one.alignment};
    }
    case Kind::kStruct: {
      Room all{0, 1};
      for (const types::Field& field : type.fields) {
        const Room one = room_of(*field.type);
        all.size = aligned(all.size, one.alignment) + one.size;
        all.alignment = std::max(all.alignment, one.alignment);
      }
      return {aligned(all.size, all.alignment), all.alignment};
    }
    default:
      return {type.size, type.size};
  }
}

/// Calls `visit(field, offset)` for the fields of a struct in C.
template <typename Visit>
void visit_fields(const Type& type, const Visit& visit) {
  std::size_t offset = 0;
  for (const types::Field& field : type.fields) {
    const Room room = room_of(*field.type);
    offset = aligned(offset, room.alignment);
    visit(field, offset);
    offset += room.size;
  }
}

bool is_number(const Type& type) { return type.kind <= Kind::kEnum; }

/// Cyclone's code of a type, without its place: `DDS_OP_VAL_8BY`.
std::uint32_t code_of(const Type& type) {
  switch (type.kind) {
    case Kind::kBool:
      return DDS_OP_VAL_BLN;
    case Kind::kFixedText:
      return DDS_OP_VAL_BST;
    case Kind::kVector:
      return DDS_OP_VAL_SEQ;
    case Kind::kArray:
      return DDS_OP_VAL_ARR;
    case Kind::kStruct:
      return DDS_OP_VAL_STU;
    default:
      return type.size == 1   ? DDS_OP_VAL_1BY
             : type.size == 2 ? DDS_OP_VAL_2BY
             : type.size == 4 ? DDS_OP_VAL_4BY
                              : DDS_OP_VAL_8BY;
  }
}

std::uint32_t flags_of(const Type& type) {
  switch (type.kind) {
    case Kind::kFloat:
    case Kind::kDouble:
      return DDS_OP_FLAG_FP;
    case Kind::kInt8:
    case Kind::kInt16:
    case Kind::kInt32:
    case Kind::kInt64:
      return DDS_OP_FLAG_SGN;
    case Kind::kEnum:
      return flags_of(*type.underlying);
    default:
      return 0;
  }
}

using Ops = std::vector<std::uint32_t>;

std::uint32_t word(std::size_t number) { return static_cast<std::uint32_t>(number); }

void append_ops(const Type& type, std::size_t offset, Ops& ops);

/// Of a part that is called for each element: (next instruction, first of the part).
Ops part_of(const Type& element) {
  Ops part;
  append_ops(element, 0, part);
  part.push_back(DDS_OP_RTS);
  return part;
}

void append_array(const Type& type, std::size_t offset, Ops& ops) {
  // Arrays of arrays are one array on the wire.
  const Type* element = type.element;
  std::size_t count = type.count;
  for (; element->kind == Kind::kArray; element = element->element) count *= element->count;
  ops.insert(ops.end(), {word(DDS_OP_ADR) | word(DDS_OP_TYPE_ARR) | code_of(*element) << 8 |
                             flags_of(*element),
                         word(offset), word(count)});
  if (is_number(*element)) return;
  if (element->kind == Kind::kFixedText) {
    ops.insert(ops.end(), {0u, word(element->count + 1)});
    return;
  }
  constexpr std::size_t kWords = 5;
  const Ops part = part_of(*element);
  ops.push_back(word((kWords + part.size()) << 16 | kWords));
  ops.push_back(word(room_of(*element).size));
  ops.insert(ops.end(), part.begin(), part.end());
}

void append_sequence(const Type& type, std::size_t offset, Ops& ops) {
  const Type& element = *type.element;
  ops.insert(ops.end(),
             {word(DDS_OP_ADR) | word(DDS_OP_TYPE_SEQ) | code_of(element) << 8 | flags_of(element),
              word(offset)});
  if (is_number(element)) return;
  if (element.kind == Kind::kFixedText) return ops.push_back(word(element.count + 1));
  constexpr std::size_t kWords = 4;
  const Ops part = part_of(element);
  ops.push_back(word(room_of(element).size));
  ops.push_back(word((kWords + part.size()) << 16 | kWords));
  ops.insert(ops.end(), part.begin(), part.end());
}

void append_ops(const Type& type, std::size_t offset, Ops& ops) {
  switch (type.kind) {
    case Kind::kStruct:
      return visit_fields(type, [&](const types::Field& field, std::size_t at) {
        append_ops(*field.type, offset + at, ops);
      });
    case Kind::kArray:
      return append_array(type, offset, ops);
    case Kind::kVector:
      return append_sequence(type, offset, ops);
    default:
      ops.insert(ops.end(),
                 {word(DDS_OP_ADR) | code_of(type) << 16 | flags_of(type), word(offset)});
      if (type.kind == Kind::kFixedText) ops.push_back(word(type.count + 1));
  }
}

void read_value(const Type& type, const std::byte* at, void* value) {
  switch (type.kind) {
    case Kind::kStruct:
      return visit_fields(type, [&](const types::Field& field, std::size_t offset) {
        read_value(*field.type, at + offset, static_cast<std::byte*>(value) + field.offset);
      });
    case Kind::kArray: {
      const std::size_t size = room_of(*type.element).size;
      for (std::size_t i = 0; i < type.count; ++i) {
        read_value(*type.element, at + i * size,
                   static_cast<std::byte*>(value) + i * type.element->size);
      }
      return;
    }
    case Kind::kVector: {
      dds_sequence_t sequence;
      std::memcpy(&sequence, at, sizeof sequence);
      const std::size_t size = room_of(*type.element).size;
      type.vector_resize(value, sequence._length);
      auto* const elements = static_cast<std::byte*>(type.vector_data(value));
      for (std::size_t i = 0; i < sequence._length; ++i) {
        read_value(*type.element, reinterpret_cast<const std::byte*>(sequence._buffer) + i * size,
                   elements + i * type.element->size);
      }
      return;
    }
    case Kind::kFixedText:
      return type.set_text(value, reinterpret_cast<const char*>(at));
    default:
      std::memcpy(value, at, type.size);
  }
}

}  // namespace

DescribedType::DescribedType(const Type& type) : type_(type), name_(types::dds_name(type)) {
  append_ops(type, 0, ops_);
  const auto instructions = word(ops_.size() + 1);
  ops_.push_back(DDS_OP_RTS);
  const Room room = room_of(type);
  descriptor_ =
      std::make_unique<dds_topic_descriptor_t>(dds_topic_descriptor_t{word(room.size),
                                                                      word(room.alignment),
                                                                      0u,
                                                                      0u,
                                                                      name_.c_str(),
                                                                      nullptr,
                                                                      instructions,
                                                                      ops_.data(),
                                                                      "",
                                                                      {nullptr, 0},
                                                                      {nullptr, 0},
                                                                      0u});
}

DescribedType::~DescribedType() = default;

const void* DescribedType::sample_of(const void* value) {
  blocks_.clear();
  std::byte* const sample = blocks_.emplace_back(new std::byte[room_of(type_).size]()).get();
  fill(type_, value, sample);
  return sample;
}

void DescribedType::read(const void* sample, void* value) const {
  read_value(type_, static_cast<const std::byte*>(sample), value);
}

void DescribedType::fill(const Type& type, const void* value, std::byte* at) {
  const auto* const bytes = static_cast<const std::byte*>(value);
  switch (type.kind) {
    case Kind::kStruct:
      return visit_fields(type, [&](const types::Field& field, std::size_t offset) {
        fill(*field.type, bytes + field.offset, at + offset);
      });
    case Kind::kArray: {
      const std::size_t size = room_of(*type.element).size;
      for (std::size_t i = 0; i < type.count; ++i) {
        fill(*type.element, bytes + i * type.element->size, at + i * size);
      }
      return;
    }
    case Kind::kVector: {
      const std::size_t count = type.vector_size(value);
      const std::size_t size = room_of(*type.element).size;
      std::byte* const elements =
          blocks_.emplace_back(new std::byte[std::max<std::size_t>(1, count * size)]()).get();
      const auto* const from = static_cast<const std::byte*>(
          type.vector_data(const_cast<void*>(value)));  // NOLINT: read
      for (std::size_t i = 0; i < count; ++i) {
        fill(*type.element, from + i * type.element->size, elements + i * size);
      }
      const dds_sequence_t sequence{word(count), word(count),
                                    reinterpret_cast<std::uint8_t*>(elements), false};
      std::memcpy(at, &sequence, sizeof sequence);
      return;
    }
    case Kind::kFixedText: {
      const std::string_view text = type.text(value);
      std::copy_n(text.data(), text.size(), reinterpret_cast<char*>(at));
      return;
    }
    default:
      std::memcpy(at, value, type.size);
  }
}

}  // namespace armature::ros2::internal
