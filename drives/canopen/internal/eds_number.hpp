// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

#include "armature/base/result.hpp"
#include "drives/canopen/cob_id.hpp"

namespace armature::canopen::internal {

/// A number of CiA 306: `12`, `-3`, `0x1A`, `017`, `$NODEID+0x180`, `0x180+$NODEID`. The error says
/// what was expected. Unsigned numbers of 64 bits are taken by their bits.
base::Result<std::int64_t> parse_eds_number(std::string_view text, NodeId node);

}  // namespace armature::canopen::internal
