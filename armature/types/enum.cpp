// SPDX-License-Identifier: Apache-2.0
#include "armature/types/enum.hpp"

#include <algorithm>
#include <cstring>

#include "armature/base/alternatives.hpp"
#include "armature/base/near_name.hpp"
#include "armature/types/elements.hpp"

namespace armature::types {
namespace {

std::int64_t number_of(const Type& type, const void* value) {
  return with_scalar(type.underlying->kind, [value]<typename T>(std::type_identity<T>) {
    T number{};
    std::memcpy(&number, value, sizeof number);
    return static_cast<std::int64_t>(number);
  });
}

const Enumerator* enumerator_of(const Type& type, const void* value) {
  const std::int64_t number = number_of(type, value);
  for (const Enumerator& enumerator : type.enumerators) {
    if (enumerator.value == number) return &enumerator;
  }
  return nullptr;
}

}  // namespace

std::string_view enumerator_name(const Type& type, const void* value) {
  const Enumerator* const found = enumerator_of(type, value);
  return found == nullptr ? std::string_view() : found->name;
}

const Enumerator* find_enumerator(const Type& type, std::string_view name) {
  const auto found = std::find_if(type.enumerators.begin(), type.enumerators.end(),
                                  [&](const Enumerator& each) { return each.name == name; });
  return found == type.enumerators.end() ? nullptr : &*found;
}

bool is_enumerator(const Type& type, const void* value) {
  return enumerator_of(type, value) != nullptr;
}

void set_enumerator(const Type& type, const Enumerator& enumerator, void* value) {
  with_scalar(type.underlying->kind, [&]<typename T>(std::type_identity<T>) {
    const T number = static_cast<T>(enumerator.value);
    std::memcpy(value, &number, sizeof number);
  });
}

std::vector<std::string> enumerator_names(const Type& type) {
  std::vector<std::string> names;
  for (const Enumerator& each : type.enumerators) names.push_back(each.name);
  return names;
}

std::string enumerator_values(const Type& type) {
  std::string text = "{";
  for (const Enumerator& each : type.enumerators) {
    if (text.back() != '{') text += ',';
    text += each.name + "=" + std::to_string(each.value);
  }
  return text + "}";
}

std::string enumerator_list(const Type& type) { return base::alternatives(enumerator_names(type)); }

std::string unknown_enumerator(const Type& type, std::string_view name) {
  return "expected " + enumerator_list(type) + ", found '" + std::string(name) + "'";
}

std::string near_enumerator(const Type& type, std::string_view name) {
  return base::suggestion(name, enumerator_names(type)).text;
}

}  // namespace armature::types
