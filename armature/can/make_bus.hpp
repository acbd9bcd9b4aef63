// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "armature/can/bus.hpp"

namespace armature::can {

/// A bus outside this process, by its name: `virtual:` and a path, such as
/// `virtual:/tmp/janus.bus`, is a `SharedBus`; anything else an interface of this machine, such as
/// can0, a `SocketCan`.
/// @param bit_rate  that the station has on a virtual bus; an interface has its own
std::unique_ptr<Bus> make_bus(const std::string& name, std::uint32_t bit_rate);

/// Of another process, which simulates what is on it; else there may be a robot.
bool is_virtual(std::string_view name);

}  // namespace armature::can
