// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/guard/internal/places.hpp"
#include "armature/platform/elf/symbols.hpp"

namespace armature::guard {

/// What happened at `place`, with its call stack, for people.
std::string describe(const Place& place, platform::Symbols& symbols);

/// `3 violations at 2 places`.
std::string summary(const Places& places);

}  // namespace armature::guard
