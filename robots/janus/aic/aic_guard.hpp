// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/guardian/guardian.hpp"

namespace armature::janus {

/// What a guardian may do to AIC cards: apply their brakes, switch their actuators off, and ask for
/// their states.
/// @param cards     their numbers
/// @param bus       outside this process, as `can::make_bus` has it
/// @param bit_rate  of its station on a virtual bus
/// @param period    of the cycle
guardian::Orders guard_orders(const std::vector<int>& cards, const std::string& bus,
                              std::uint32_t bit_rate, base::Duration period);

}  // namespace armature::janus
