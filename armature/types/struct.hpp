// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "armature/types/internal/for_each.hpp"
#include "armature/types/type.hpp"

/// Describes a struct to files, tools, recorder and network. Write it once, in the struct's own
/// namespace, right after the struct. A field in parentheses also gives its unit and documentation.
///
///     struct Pose { double x, y, yaw; };
///     ARMATURE_STRUCT(Pose, x, y, yaw);
///     ARMATURE_STRUCT(Pose, (x, "m", "ahead of the dock"), (y, "m"), (yaw, "rad"));  // the same
///
/// Every field is listed; their order here is their order in the text and binary form.
#define ARMATURE_STRUCT(Name, ...)                                                               \
  inline const ::armature::types::Type& armature_describe(const Name*) {                         \
    static_assert(::armature::types::internal::lists_each_field_once(                            \
                      ::armature::types::internal::kFootprint<Name>,                             \
                      {ARMATURE_INTERNAL_FOR_EACH(ARMATURE_INTERNAL_PLACE,                       \
                                                  Name __VA_OPT__(, ) __VA_ARGS__)}),            \
                  "ARMATURE_STRUCT(" #Name ", ...) must list every field of " #Name " once");    \
    static const ::armature::types::Type& type = ::armature::types::internal::make_struct(       \
        #Name, ::armature::types::internal::kFootprint<Name>,                                    \
        ::armature::types::internal::kLifetime<Name>,                                            \
        {ARMATURE_INTERNAL_FOR_EACH(ARMATURE_INTERNAL_FIELD, Name __VA_OPT__(, ) __VA_ARGS__)}); \
    return type;                                                                                 \
  }                                                                                              \
  static_assert(::std::is_standard_layout_v<Name>,                                               \
                #Name " needs all its fields public and in one struct, and no virtual function")

// `argument` is a field's name, or (name, unit, documentation).
#define ARMATURE_INTERNAL_FIELD(Name, argument)              \
  ARMATURE_INTERNAL_CALL(ARMATURE_INTERNAL_MAKE_FIELD, Name, \
                         ARMATURE_INTERNAL_WITHOUT_PARENTHESES(argument)),
#define ARMATURE_INTERNAL_PLACE(Name, argument)              \
  ARMATURE_INTERNAL_CALL(ARMATURE_INTERNAL_MAKE_PLACE, Name, \
                         ARMATURE_INTERNAL_WITHOUT_PARENTHESES(argument)),
#define ARMATURE_INTERNAL_CALL(macro, ...) macro(__VA_ARGS__)

#define ARMATURE_INTERNAL_MAKE_FIELD(Name, field, ...)                                        \
  ::armature::types::internal::make_field(#field, offsetof(Name, field),                      \
                                          ::armature::types::type_of<decltype(Name::field)>() \
                                              __VA_OPT__(, ) __VA_ARGS__)
#define ARMATURE_INTERNAL_MAKE_PLACE(Name, field, ...) \
  { offsetof(Name, field), sizeof(Name::field), alignof(decltype(Name::field)) }
