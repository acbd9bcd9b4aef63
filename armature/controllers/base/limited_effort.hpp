// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <type_traits>

#include "armature/control/joint_limiter.hpp"
#include "armature/types/type.hpp"

namespace armature::control {

namespace internal {

/// So that ports and operations carry it. It is sealed: what tools, files and scripts make is no
/// such command, and no port of another type can be connected to one of this.
template <typename Command>
const types::Type& sealed_number(std::string_view name) {
  static_assert(std::is_standard_layout_v<Command> && sizeof(Command) == sizeof(double),
                "the number is all that there is");
  static const types::Type& type = types::internal::make_sealed(
      name, types::internal::kFootprint<Command>, types::internal::kLifetime<Command>,
      types::internal::make_field("value", 0, types::type_of<double>()));
  return type;
}

}  // namespace internal

inline const types::Type& armature_describe(const LimitedEffort*) {
  return internal::sealed_number<LimitedEffort>("LimitedEffort");
}
inline const types::Type& armature_describe(const LimitedVelocity*) {
  return internal::sealed_number<LimitedVelocity>("LimitedVelocity");
}
inline const types::Type& armature_describe(const LimitedPosition*) {
  return internal::sealed_number<LimitedPosition>("LimitedPosition");
}

/// Sealed likewise: no tool, file, script or peer switches on or opens a brake.
inline const types::Type& armature_describe(const DrivePermit*) {
  static_assert(std::is_standard_layout_v<DrivePermit> && sizeof(DrivePermit) == sizeof(bool),
                "the flag is all that there is");
  static const types::Type& type =
      types::internal::make_sealed("DrivePermit", types::internal::kFootprint<DrivePermit>,
                                   types::internal::kLifetime<DrivePermit>,
                                   types::internal::make_field("armed", 0, types::type_of<bool>()));
  return type;
}

}  // namespace armature::control
