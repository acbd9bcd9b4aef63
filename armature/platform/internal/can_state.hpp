// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace armature::platform::internal {

/// The state of the controller behind a CAN interface, as <linux/can/netlink.h> counts them;
/// nothing if it has none, as virtual interfaces, or if the kernel does not tell.
/// @param interface  its index
std::optional<std::uint32_t> can_state(unsigned interface);

}  // namespace armature::platform::internal
