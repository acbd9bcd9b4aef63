// SPDX-License-Identifier: Apache-2.0
#include "armature/remote/value_codec.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>

#include "armature/types/elements.hpp"
#include "armature/types/enum.hpp"

namespace armature::remote {
namespace {

using types::Kind;
using types::Type;

std::string_view scalar_name(Kind kind) {
  switch (kind) {
    case Kind::kBool:
      return "bool";
    case Kind::kInt8:
      return "char";
    case Kind::kUint8:
      return "byte";
    case Kind::kInt16:
      return "short";
    case Kind::kUint16:
      return "unsigned short";
    case Kind::kInt32:
      return "int";
    case Kind::kUint32:
      return "unsigned int";
    case Kind::kInt64:
      return "long";
    case Kind::kUint64:
      return "unsigned long";
    case Kind::kFloat:
      return "float";
    case Kind::kDouble:
      return "double";
    default:
      return "";
  }
}

/// Bytes that a value has at least, so that a count can be believed before memory is asked for.
std::size_t least_size(const Type& type) {
  if (types::is_text(type) || type.kind == Kind::kVector) return sizeof(std::uint32_t);
  if (type.kind == Kind::kArray) return type.count * least_size(*type.element);
  if (type.kind != Kind::kStruct) return type.size;
  std::size_t size = 0;
  for (const types::Field& field : type.fields) size += least_size(*field.type);
  return size;
}

bool decode_text(ride::Decoder& from, const Type& type, void* to) {
  std::string_view text;
  if (!from.take(text)) return false;
  if (type.kind == Kind::kFixedText && text.size() > type.count) return false;
  from.hold(text.size());
  type.set_text(to, text);
  return true;
}

bool decode_elements(ride::Decoder& from, const Type& element, void* first, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    Incoming one{&element, types::at_offset(first, i * element.size)};
    if (!decode(from, one)) return false;
  }
  return true;
}

bool decode_vector(ride::Decoder& from, const Type& type, void* to) {
  std::uint32_t count = 0;
  if (!from.take(count)) return false;
  if (count > from.remaining() / std::max<std::size_t>(least_size(*type.element), 1)) return false;
  from.hold(count * type.element->size);
  type.vector_resize(to, count);
  return decode_elements(from, *type.element, type.vector_data(to), count);
}

}  // namespace

std::string canonical(const Type& type) {
  if (types::is_text(type)) return "String";
  if (type.kind == Kind::kVector) return "Array<" + canonical(*type.element) + ">";
  if (type.kind == Kind::kArray) {
    return "Array<" + canonical(*type.element) + "," + std::to_string(type.count) + ">";
  }
  if (type.kind == Kind::kEnum) {
    return "enum " + type.name + ":" + std::string(scalar_name(type.underlying->kind)) +
           types::enumerator_values(type);
  }
  if (type.kind != Kind::kStruct) return std::string(scalar_name(type.kind));
  std::string text = "struct " + type.name + "{";
  for (const types::Field& field : type.fields) {
    if (&field != &type.fields.front()) text += ",";
    text += canonical(*field.type);
  }
  return text + "}";
}

bool can_travel(const Type& type) {
  if (type.sealed) return false;
  if (type.element != nullptr) return can_travel(*type.element);
  return std::all_of(type.fields.begin(), type.fields.end(),
                     [](const types::Field& field) { return can_travel(*field.type); });
}

void encode(ride::Encoder& to, const Outgoing& value) {
  const Type& type = *value.type;
  if (type.kind == Kind::kEnum) return encode(to, Outgoing{type.underlying, value.data});
  if (types::is_scalar(type)) {
    types::with_scalar(type.kind, [&]<typename T>(std::type_identity<T>) {
      to.put(*static_cast<const T*>(value.data));
    });
    return;
  }
  if (types::is_text(type)) return to.put(type.text(value.data));
  if (type.kind == Kind::kStruct) {
    for (const types::Field& field : type.fields) {
      encode(to, Outgoing{field.type, types::at_offset(value.data, field.offset)});
    }
    return;
  }
  const std::size_t count = types::element_count(type, value.data);
  if (type.kind == Kind::kVector) to.put(static_cast<std::uint32_t>(count));
  const void* const first = types::elements(type, value.data);
  for (std::size_t i = 0; i < count; ++i) {
    encode(to, Outgoing{type.element, types::at_offset(first, i * type.element->size)});
  }
}

void encode(ride::Encoder& to, const OutgoingArguments& all) {
  for (std::size_t i = 0; i < all.signature->arguments.size(); ++i) {
    encode(to, Outgoing{all.signature->arguments[i].type, all.arguments[i]});
  }
}

bool decode(ride::Decoder& from, Incoming& value) {
  const Type& type = *value.type;
  if (types::is_text(type)) return decode_text(from, type, value.data);
  if (type.kind == Kind::kVector) return decode_vector(from, type, value.data);
  if (type.kind == Kind::kArray) {
    return decode_elements(from, *type.element, value.data, type.count);
  }
  if (type.kind == Kind::kStruct) {
    return std::all_of(type.fields.begin(), type.fields.end(), [&](const types::Field& field) {
      Incoming one{field.type, types::at_offset(value.data, field.offset)};
      return decode(from, one);
    });
  }
  if (type.kind == Kind::kEnum) {
    Incoming number{type.underlying, value.data};
    return decode(from, number) && types::is_enumerator(type, value.data);
  }
  return types::with_scalar(type.kind, [&]<typename T>(std::type_identity<T>) {
    return from.take(*static_cast<T*>(value.data));
  });
}

}  // namespace armature::remote
