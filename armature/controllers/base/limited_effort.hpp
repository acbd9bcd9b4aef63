// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <type_traits>

#include "armature/control/joint_limiter.hpp"
#include "armature/types/type.hpp"

namespace armature::control {

/// So that ports and operations carry it. It is sealed: what tools, files and scripts make is no
/// LimitedEffort, and no port of another type can be connected to one of this.
inline const types::Type& armature_describe(const LimitedEffort*) {
  static_assert(std::is_standard_layout_v<LimitedEffort> && sizeof(LimitedEffort) == sizeof(double),
                "the number is all that there is");
  static const types::Type& type = types::internal::make_sealed(
      "LimitedEffort", types::internal::kFootprint<LimitedEffort>,
      types::internal::kLifetime<LimitedEffort>,
      types::internal::make_field("value", 0, types::type_of<double>()));
  return type;
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
