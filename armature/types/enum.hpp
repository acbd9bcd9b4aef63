// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "armature/types/internal/for_each.hpp"
#include "armature/types/type.hpp"

/// Describes an enumeration to files, scripts, tools, recorder and network by the names of its
/// values. Write it once, in the enumeration's own namespace, right after it; after the class, if
/// the enumeration is a member of one.
///
///     enum class Overrun : std::uint8_t { kSkip, kCatchUp, kFault };
///     ARMATURE_ENUM(Overrun, kSkip, kCatchUp, kFault);  // skip, catch_up, fault
///
/// Every enumerator is listed (the compiler warns of one that is not); one of them is 0, which is
/// what a value has that nobody has set.
#define ARMATURE_ENUM(Name, ...)                                                                  \
  inline const ::armature::types::Type& armature_describe(const Name*) {                          \
    static_assert(ARMATURE_INTERNAL_FOR_EACH(ARMATURE_INTERNAL_IS_ZERO, Name, __VA_ARGS__) false, \
                  #Name " needs an enumerator of the value 0");                                   \
    [[maybe_unused]] const auto lists_each = [](Name value) {                                     \
      switch (value) { ARMATURE_INTERNAL_FOR_EACH(ARMATURE_INTERNAL_CASE, Name, __VA_ARGS__) }    \
    };                                                                                            \
    static const ::armature::types::Type& type = ::armature::types::internal::make_enum(          \
        #Name, ::armature::types::type_of<::std::underlying_type_t<Name>>(),                      \
        ::armature::types::internal::kLifetime<Name>,                                             \
        {ARMATURE_INTERNAL_FOR_EACH(ARMATURE_INTERNAL_ENUMERATOR, Name, __VA_ARGS__)});           \
    return type;                                                                                  \
  }                                                                                               \
  static_assert(::std::is_enum_v<Name>, #Name " is described as an enumeration")

#define ARMATURE_INTERNAL_IS_ZERO(Name, enumerator) \
  static_cast<::std::underlying_type_t<Name>>(Name::enumerator) == 0 ||
#define ARMATURE_INTERNAL_CASE(Name, enumerator) \
  case Name::enumerator:                         \
    break;
#define ARMATURE_INTERNAL_ENUMERATOR(Name, enumerator) \
  {#enumerator, static_cast<::std::int64_t>(Name::enumerator)},

namespace armature::types {

/// The name of a value of an enumeration, such as `catch_up`; empty if none of its enumerators has
/// this value. @rt nonblocking, no allocation
std::string_view enumerator_name(const Type& type, const void* value);

/// The enumerator with this name, or nullptr.
const Enumerator* find_enumerator(const Type& type, std::string_view name);

/// True if one of the enumerators has the value. @rt nonblocking, no allocation
bool is_enumerator(const Type& type, const void* value);

/// Makes `value` that of the enumerator. @rt nonblocking, no allocation
void set_enumerator(const Type& type, const Enumerator& enumerator, void* value);

/// `skip, catch_up or fault`, for messages.
std::string enumerator_list(const Type& type);

/// What is wrong with `name`, and which names there are: `expected skip, catch_up or fault, found
/// 'skp'`.
std::string unknown_enumerator(const Type& type, std::string_view name);

/// The one that is spelled most like `name`, as advice; empty if none is near.
std::string near_enumerator(const Type& type, std::string_view name);

/// `catch_up` for Overrun::kCatchUp. @rt nonblocking, no allocation after the first call
template <typename Enum>
std::string_view name_of(Enum value) requires std::is_enum_v<Enum> {
  return enumerator_name(type_of<Enum>(), &value);
}

/// The value with this name, if there is one.
template <typename Enum>
std::optional<Enum> value_named(std::string_view name) {
  const Enumerator* const found = find_enumerator(type_of<Enum>(), name);
  return found == nullptr ? std::nullopt : std::optional(static_cast<Enum>(found->value));
}

}  // namespace armature::types
