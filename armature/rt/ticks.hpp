// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/platform/clock.hpp"

namespace armature::rt {

/// The cycle counter and the clock, for those who may not reach down to the platform.
using platform::monotonic_now;
using platform::tick_period_ns;
using platform::ticks;

}  // namespace armature::rt
