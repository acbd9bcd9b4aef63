// SPDX-License-Identifier: Apache-2.0
#include "armature/types/made.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "armature/base/hash.hpp"
#include "armature/types/elements.hpp"

namespace armature::types {
namespace {

using internal::kLifetime;
using internal::kVectorAccess;
using internal::Lifetime;
using internal::round_up;

/// Sizes of structs and arrays that were made. A type knows its size by its functions only, so
/// there are functions for each size: as many as there are places.
constexpr std::size_t kMostSizes = 128;
std::array<std::size_t, kMostSizes> sizes{};

/// Of values that are copied as bytes and whose bytes are all 0 at first.
template <std::size_t Place>
constexpr Lifetime kLifetimeOfBytes{
    [](void* at) { std::memset(at, 0, sizes[Place]); },
    [](void*) {},
    [](void* to, const void* from) { std::memmove(to, from, sizes[Place]); },
};

/// nullptr if there are too many sizes.
const Lifetime* lifetime_of_bytes(std::size_t size) {
  static constexpr auto kEach = []<std::size_t... I>(std::index_sequence<I...>) {
    return std::array<Lifetime, sizeof...(I)>{kLifetimeOfBytes<I>...};
  }
  (std::make_index_sequence<kMostSizes>{});
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  const auto place =
      std::ranges::find_if(sizes, [&](std::size_t s) { return s == size || s == 0; });
  if (place == sizes.end()) return nullptr;
  *place = size;
  return &kEach[static_cast<std::size_t>(place - sizes.begin())];
}

Type blank(std::string name, Kind kind, std::size_t size, std::size_t alignment,
           const Lifetime& lifetime) {
  Type type{};
  type.name = std::move(name);
  type.kind = kind;
  type.size = size;
  type.alignment = alignment;
  type.construct = lifetime.construct;
  type.destroy = lifetime.destroy;
  type.assign = lifetime.assign;
  return type;
}

/// A type and the texts that its fields refer to.
struct Made {
  std::vector<MadeField> fields;
  Type type;
};

/// What tells one description from another.
std::string key_of(const Type& type, const std::vector<MadeField>& fields) {
  std::string key = layout_text(type);
  for (const MadeField& field : fields) {
    key += '\0' + std::to_string(reinterpret_cast<std::uintptr_t>(field.type)) + '\0' + field.unit +
           '\0' + field.doc;
  }
  return key;
}

/// The type of this description: the one that was made before, or from now on this one.
const Type& keep_made(Type type, std::vector<MadeField> fields = {}) {
  static std::mutex mutex;
  static auto& all = *new std::map<std::string, std::unique_ptr<Made>>;
  type.hash = base::fnv1a(layout_text(type));
  const std::lock_guard lock(mutex);
  std::unique_ptr<Made>& made = all[key_of(type, fields)];
  if (made != nullptr) return made->type;
  made = std::make_unique<Made>(Made{std::move(fields), std::move(type)});
  for (std::size_t i = 0; i < made->fields.size(); ++i) {
    const MadeField& from = made->fields[i];
    Field& field = made->type.fields[i];
    field.name = from.name;
    field.unit = from.unit;
    field.doc = from.doc;
  }
  return made->type;
}

std::string too_large(const std::string& name, std::size_t size) {
  return name + " has " + std::to_string(size) + " bytes, more than the " +
         std::to_string(kLargestMade) + " that a struct or array known by its description may have";
}

base::Error too_many_sizes(const std::string& name) {
  return base::Error{name + " has another size than " + std::to_string(kMostSizes) +
                     " structs and arrays before it, and there is room for no more"};
}

std::string grows(const Type& type) {
  return type.name + " grows, and a struct or array known by its description has a fixed size";
}

template <typename T>
void set_vector(Type& list) {
  list.size = sizeof(std::vector<T>);
  list.alignment = alignof(std::vector<T>);
  list.construct = kLifetime<std::vector<T>>.construct;
  list.destroy = kLifetime<std::vector<T>>.destroy;
  list.assign = kLifetime<std::vector<T>>.assign;
  list.vector_size = kVectorAccess<std::vector<T>>.size;
  list.vector_resize = kVectorAccess<std::vector<T>>.resize;
  list.vector_data = kVectorAccess<std::vector<T>>.data;
}

}  // namespace

base::Result<const Type*> made_struct(const std::string& name,
                                      const std::vector<MadeField>& fields) {
  Type type{};
  type.alignment = 1;
  for (const MadeField& field : fields) {
    if (field.type->grows) return base::Error{"field " + field.name + ": " + grows(*field.type)};
    const std::size_t offset = round_up(type.size, field.type->alignment);
    type.fields.push_back({field.name, offset, field.type, field.unit, field.doc});
    type.size = offset + field.type->size;
    type.alignment = std::max(type.alignment, field.type->alignment);
  }
  const std::size_t size = round_up(type.size, type.alignment);
  if (size > kLargestMade) return base::Error{too_large("struct " + name, size)};
  const Lifetime* const lifetime = lifetime_of_bytes(size);
  if (lifetime == nullptr) return too_many_sizes("struct " + name);
  Type made = blank(name, Kind::kStruct, size, type.alignment, *lifetime);
  made.fields = std::move(type.fields);
  return &keep_made(std::move(made), fields);
}

base::Result<const Type*> made_array(const Type& element, std::size_t count) {
  if (element.grows) return base::Error{grows(element)};
  std::string name = "array<" + element.name + "," + std::to_string(count) + ">";
  if (count > kLargestMade || count * element.size > kLargestMade) {
    return base::Error{too_large(name, count * element.size)};
  }
  const std::size_t size = count * element.size;
  const Lifetime* const lifetime = lifetime_of_bytes(size);
  if (lifetime == nullptr) return too_many_sizes(name);
  Type made = blank(std::move(name), Kind::kArray, size, element.alignment, *lifetime);
  made.element = &element;
  made.count = count;
  return &keep_made(std::move(made));
}

base::Result<const Type*> made_vector(const Type& element) {
  Type made{};
  made.name = "vector<" + element.name + ">";
  made.kind = Kind::kVector;
  made.element = &element;
  made.grows = true;
  if (element.kind == Kind::kText) {
    set_vector<std::string>(made);
  } else if (is_scalar(element)) {
    const Kind kind = element.kind == Kind::kEnum ? element.underlying->kind : element.kind;
    with_scalar(kind, [&]<typename T>(std::type_identity<T>) {
      // A vector<bool> has no elements in memory.
      set_vector<std::conditional_t<std::is_same_v<T, bool>, std::uint8_t, T>>(made);
    });
  } else {
    return base::Error{
        made.name +
        " has elements that are neither numbers, bools, enumerations nor texts of any "
        "length: give it a number of elements"};
  }
  return &keep_made(std::move(made));
}

const Type& made_enum(const std::string& name, const Type& underlying,
                      const std::vector<Enumerator>& enumerators) {
  const Lifetime lifetime{underlying.construct, underlying.destroy, underlying.assign};
  Type made = blank(name, Kind::kEnum, underlying.size, underlying.alignment, lifetime);
  made.underlying = &underlying;
  made.enumerators = enumerators;
  return keep_made(std::move(made));
}

}  // namespace armature::types
