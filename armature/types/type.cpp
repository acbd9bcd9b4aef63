// SPDX-License-Identifier: Apache-2.0
#include "armature/types/type.hpp"

#include <algorithm>
#include <utility>

#include "armature/base/hash.hpp"
#include "armature/types/elements.hpp"

namespace armature::types {
namespace {

using internal::Footprint;
using internal::kFootprint;
using internal::kLifetime;
using internal::Lifetime;

Type blank(std::string name, Kind kind, Footprint footprint, Lifetime lifetime) {
  Type type{};
  type.name = std::move(name);
  type.kind = kind;
  type.size = footprint.size;
  type.alignment = footprint.alignment;
  type.construct = lifetime.construct;
  type.destroy = lifetime.destroy;
  type.assign = lifetime.assign;
  return type;
}

const Type& keep(Type type) {
  type.hash = base::fnv1a(layout_text(type));
  return *new Type(std::move(type));
}

template <typename T>
const Type& make_scalar(const char* name, Kind kind) {
  return keep(blank(name, kind, kFootprint<T>, kLifetime<T>));
}

const Type& make_text() {
  Type type = blank("text", Kind::kText, kFootprint<std::string>, kLifetime<std::string>);
  type.grows = true;
  type.text = internal::kTextAccess<std::string>.view;
  type.set_text = internal::kTextAccess<std::string>.set;
  return keep(std::move(type));
}

/// `catch_up` for `kCatchUp`.
std::string file_name_of(std::string_view enumerator) {
  if (enumerator.starts_with('k')) enumerator.remove_prefix(1);
  std::string name;
  for (const char c : enumerator) {
    const bool capital = c >= 'A' && c <= 'Z';
    if (capital && !name.empty()) name += '_';
    name += capital ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return name;
}

/// The name, with `inner` as the text of an element type.
std::string name_of_list(const Type& type, const std::string& inner) {
  if (type.kind == Kind::kVector) return "vector<" + inner + ">";
  return "array<" + inner + "," + std::to_string(type.count) + ">";
}

}  // namespace

bool same_type(const Type& a, const Type& b) {
  if (&a == &b) return true;
  if (a.hash != b.hash || a.name != b.name || a.size != b.size || a.kind != b.kind) return false;
  if (a.sealed != b.sealed) return false;
  if (a.element != nullptr) return same_type(*a.element, *b.element);
  if (a.underlying != nullptr) return same_type(*a.underlying, *b.underlying);
  return std::equal(a.fields.begin(), a.fields.end(), b.fields.begin(), b.fields.end(),
                    [](const Field& x, const Field& y) {
                      return x.offset == y.offset && x.name == y.name &&
                             same_type(*x.type, *y.type);
                    });
}

std::string layout_text(const Type& type) {
  if (type.element != nullptr) return name_of_list(type, layout_text(*type.element));
  if (type.kind == Kind::kEnum) {
    return type.name + ":" + type.underlying->name + enumerator_values(type);
  }
  if (type.kind != Kind::kStruct) return type.name;
  std::string text = type.name + "{";
  for (const Field& field : type.fields) {
    if (text.back() != '{') text += ',';
    text += field.name;
    text += ':' + layout_text(*field.type);
  }
  return text + "}";
}

namespace internal {

const Type& scalar_type(Kind kind) {
  static const Type* const kScalars[] = {
      &make_scalar<bool>("bool", Kind::kBool),
      &make_scalar<std::int8_t>("int8", Kind::kInt8),
      &make_scalar<std::uint8_t>("uint8", Kind::kUint8),
      &make_scalar<std::int16_t>("int16", Kind::kInt16),
      &make_scalar<std::uint16_t>("uint16", Kind::kUint16),
      &make_scalar<std::int32_t>("int32", Kind::kInt32),
      &make_scalar<std::uint32_t>("uint32", Kind::kUint32),
      &make_scalar<std::int64_t>("int64", Kind::kInt64),
      &make_scalar<std::uint64_t>("uint64", Kind::kUint64),
      &make_scalar<float>("float", Kind::kFloat),
      &make_scalar<double>("double", Kind::kDouble),
  };
  return *kScalars[static_cast<std::size_t>(kind)];
}

const Type& text_type() {
  static const Type& type = make_text();
  return type;
}

const Type& make_fixed_text(std::size_t capacity, Footprint footprint, Lifetime lifetime,
                            TextAccess access) {
  Type type =
      blank("text<" + std::to_string(capacity) + ">", Kind::kFixedText, footprint, lifetime);
  type.count = capacity;
  type.text = access.view;
  type.set_text = access.set;
  return keep(std::move(type));
}

const Type& make_array(const Type& element, std::size_t count, Footprint footprint,
                       Lifetime lifetime) {
  Type type = blank({}, Kind::kArray, footprint, lifetime);
  type.element = &element;
  type.count = count;
  type.grows = element.grows;
  type.sealed = element.sealed;
  type.name = name_of_list(type, element.name);
  return keep(std::move(type));
}

const Type& make_vector(const Type& element, Footprint footprint, Lifetime lifetime,
                        VectorAccess access) {
  Type type = blank({}, Kind::kVector, footprint, lifetime);
  type.element = &element;
  type.grows = true;
  type.sealed = element.sealed;
  type.vector_size = access.size;
  type.vector_resize = access.resize;
  type.vector_data = access.data;
  type.name = name_of_list(type, element.name);
  return keep(std::move(type));
}

const Type& make_struct(std::string_view name, Footprint footprint, Lifetime lifetime,
                        std::initializer_list<Field> fields) {
  Type type = blank(std::string(name), Kind::kStruct, footprint, lifetime);
  type.fields = fields;
  type.grows = std::any_of(fields.begin(), fields.end(),
                           [](const Field& field) { return field.type->grows; });
  type.sealed = std::any_of(fields.begin(), fields.end(),
                            [](const Field& field) { return field.type->sealed; });
  return keep(std::move(type));
}

const Type& make_enum(std::string_view name, const Type& underlying, Lifetime lifetime,
                      std::initializer_list<Enumerator> enumerators) {
  const Footprint footprint{underlying.size, underlying.alignment};
  // A member of a class is known by its own name.
  name.remove_prefix(name.rfind(':') + 1);
  Type type = blank(std::string(name), Kind::kEnum, footprint, lifetime);
  type.underlying = &underlying;
  for (const Enumerator& each : enumerators) {
    type.enumerators.push_back({file_name_of(each.name), each.value});
  }
  return keep(std::move(type));
}

const Type& make_sealed(std::string_view name, Footprint footprint, Lifetime lifetime, Field only) {
  Type type = blank(std::string(name), Kind::kStruct, footprint, lifetime);
  type.fields = {only};
  type.sealed = true;
  return keep(std::move(type));
}

}  // namespace internal
}  // namespace armature::types
