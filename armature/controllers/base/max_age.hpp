// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

#include "armature/base/time.hpp"

namespace armature::controllers {

/// How old data on the way to an actuator may be before its reader stops: as long as the watchdogs
/// of the drives wait. A connection of a deployment may say otherwise (`max_age`, `on_old`), and
/// has to where samples are further apart.
inline constexpr base::Duration kMaxAge = std::chrono::milliseconds(100);

}  // namespace armature::controllers
