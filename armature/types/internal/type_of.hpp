// SPDX-License-Identifier: Apache-2.0
#pragma once

// Included by type.hpp only: how `type_of<T>()` finds or builds the description of `T`.

#include <initializer_list>
#include <new>

#include "armature/types/type.hpp"

namespace armature::types::internal {

struct Lifetime {
  void (*construct)(void*);
  void (*destroy)(void*);
  void (*assign)(void*, const void*);
};

struct TextAccess {
  std::string_view (*view)(const void*);
  void (*set)(void*, std::string_view);
};

struct VectorAccess {
  std::size_t (*size)(const void*);
  void (*resize)(void*, std::size_t);
  void* (*data)(void*);
};

struct Footprint {
  std::size_t size;
  std::size_t alignment;
};

// Descriptions are never destroyed, so that static objects may use them until the program ends.
const Type& scalar_type(Kind kind);
const Type& text_type();
const Type& make_fixed_text(std::size_t capacity, Footprint, Lifetime, TextAccess);
const Type& make_array(const Type& element, std::size_t count, Footprint, Lifetime);
const Type& make_vector(const Type& element, Footprint, Lifetime, VectorAccess);
const Type& make_struct(std::string_view name, Footprint, Lifetime, std::initializer_list<Field>);
/// Its enumerators are named as in C++: `kCatchUp`.
const Type& make_enum(std::string_view name, const Type& underlying, Lifetime,
                      std::initializer_list<Enumerator>);
/// A class of one private number, of which only the class itself makes values.
const Type& make_sealed(std::string_view name, Footprint, Lifetime, Field only);

inline Field make_field(std::string_view name, std::size_t offset, const Type& type,
                        std::string_view unit = {}, std::string_view doc = {}) {
  return {name, offset, &type, unit, doc};
}

struct Place {
  std::size_t offset;
  std::size_t size;
  std::size_t alignment;
};

constexpr std::size_t round_up(std::size_t value, std::size_t multiple) {
  return (value + multiple - 1) / multiple * multiple;
}

/// True if the struct begins with a field, each other place begins where one ends, and so does the
/// struct's end. A small field in another's padding goes unseen, a vector or text never does.
constexpr bool lists_each_field_once(Footprint whole, std::initializer_list<Place> fields) {
  constexpr std::size_t kLargestNaturalAlignment = alignof(std::max_align_t);
  const auto begins_once = [&](const Place& place) {
    int beginnings = 0;
    bool follows = place.offset == 0 || whole.alignment > kLargestNaturalAlignment;
    for (const Place& other : fields) {
      if (other.offset == place.offset) ++beginnings;
      if (round_up(other.offset + other.size, place.alignment) == place.offset) follows = true;
    }
    return beginnings == 1 && follows;
  };
  bool begins = false;
  bool ends = false;
  for (const Place& place : fields) {
    if (!begins_once(place)) return false;
    if (place.offset == 0) begins = true;
    if (round_up(place.offset + place.size, whole.alignment) == whole.size) ends = true;
  }
  return begins && ends;
}

using VisitLeaf = void (*)(const std::string& path, const Type&, const void* value, void* visitor);
void visit_leaves(const Type&, const void* value, std::string& path, VisitLeaf, void* visitor);

template <typename T>
inline constexpr Footprint kFootprint{sizeof(T), alignof(T)};

template <typename T>
inline constexpr Lifetime kLifetime{
    [](void* at) { ::new (at) T(); },
    [](void* at) { static_cast<T*>(at)->~T(); },
    [](void* to, const void* from) { *static_cast<T*>(to) = *static_cast<const T*>(from); },
};

template <typename T>
inline constexpr TextAccess kTextAccess{
    [](const void* text) { return std::string_view(*static_cast<const T*>(text)); },
    [](void* text, std::string_view content) { static_cast<T*>(text)->assign(content); },
};

template <typename T>
inline constexpr VectorAccess kVectorAccess{
    [](const void* vector) { return static_cast<const T*>(vector)->size(); },
    [](void* vector, std::size_t count) { static_cast<T*>(vector)->resize(count); },
    [](void* vector) { return static_cast<void*>(static_cast<T*>(vector)->data()); },
};

template <typename T>
inline constexpr bool kNever = false;

template <typename T>
concept CharacterType = std::is_same_v<T, char> || std::is_same_v<T, wchar_t> ||
    std::is_same_v<T, char8_t> || std::is_same_v<T, char16_t> || std::is_same_v<T, char32_t>;

template <typename T>
concept Number = std::is_arithmetic_v<T> && sizeof(T) <= 8 && !CharacterType<T>;

template <typename T>
concept WithDescription = requires(const T* none) {
  armature_describe(none);
};

template <typename T>
constexpr Kind scalar_kind() {
  if (std::is_same_v<T, bool>) return Kind::kBool;
  if (std::is_same_v<T, float>) return Kind::kFloat;
  if (std::is_same_v<T, double>) return Kind::kDouble;
  constexpr bool kSigned = std::is_signed_v<T>;
  switch (sizeof(T)) {
    case 1:
      return kSigned ? Kind::kInt8 : Kind::kUint8;
    case 2:
      return kSigned ? Kind::kInt16 : Kind::kUint16;
    case 4:
      return kSigned ? Kind::kInt32 : Kind::kUint32;
    default:
      return kSigned ? Kind::kInt64 : Kind::kUint64;
  }
}

template <typename T>
struct Description {
  static const Type& get() {
    if constexpr (Number<T>) {
      return scalar_type(scalar_kind<T>());
    } else if constexpr (WithDescription<T>) {
      return armature_describe(static_cast<const T*>(nullptr));
    } else {
      static_assert(kNever<T>,
                    "this type has no description: use bool, an integer, float, double, "
                    "std::string, base::FixedText, std::array, std::vector, or write "
                    "ARMATURE_STRUCT(Type, field, ...); right after the struct, in its namespace, "
                    "or ARMATURE_ENUM(Type, kEnumerator, ...); right after the enumeration");
    }
  }
};

template <>
struct Description<std::string> {
  static const Type& get() { return text_type(); }
};

template <std::size_t N>
struct Description<base::FixedText<N>> {
  using T = base::FixedText<N>;
  static const Type& get() {
    static const Type& type = make_fixed_text(N, kFootprint<T>, kLifetime<T>, kTextAccess<T>);
    return type;
  }
};

template <typename Element, std::size_t N>
struct Description<std::array<Element, N>> {
  using T = std::array<Element, N>;
  static_assert(N > 0, "an array in a described type has at least one element");
  static const Type& get() {
    static const Type& type = make_array(type_of<Element>(), N, kFootprint<T>, kLifetime<T>);
    return type;
  }
};

template <typename Element>
struct Description<std::vector<Element>> {
  using T = std::vector<Element>;
  static_assert(!std::is_same_v<Element, bool>,
                "std::vector<bool> has no elements in memory: use std::vector<std::uint8_t>");
  static const Type& get() {
    if constexpr (!std::is_same_v<Element, bool>) {
      static const Type& type =
          make_vector(type_of<Element>(), kFootprint<T>, kLifetime<T>, kVectorAccess<T>);
      return type;
    }
  }
};

}  // namespace armature::types::internal

namespace armature::types {

template <typename T>
const Type& type_of() {
  return internal::Description<std::remove_cv_t<T>>::get();
}

template <typename Visitor>
void visit_leaves(const Type& type, const void* value, Visitor&& visitor, const std::string& path) {
  const auto visit = [](const std::string& at, const Type& leaf, const void* content, void* to) {
    (*static_cast<std::remove_reference_t<Visitor>*>(to))(at, leaf, content);
  };
  using Pointer = std::remove_const_t<std::remove_reference_t<Visitor>>*;
  std::string place = path;
  internal::visit_leaves(type, value, place, visit, const_cast<Pointer>(&visitor));
}

}  // namespace armature::types
