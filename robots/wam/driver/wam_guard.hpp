// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/base/time.hpp"
#include "armature/guardian/guardian.hpp"
#include "robots/wam/driver/wam_record.hpp"

namespace armature::wam {

/// What a guardian may do to an arm: set its pucks idle, which brakes their motors and drives none,
/// and ask them for their mode. To groups of pucks, so that none is left out on arms whose groups
/// are others.
/// @param bus     outside this process, as `can::make_bus` has it
/// @param period  of the cycle
guardian::Orders guard_orders(const WamRecord& arm, const std::string& bus, base::Duration period);

}  // namespace armature::wam
