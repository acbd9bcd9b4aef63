// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace armature::ros2::internal {

/// Cyclone DDS receives at all addresses of the machine, whatever interface it is told. From this
/// on its sockets take what comes by the loopback interface, and nothing else.
/// @param domain  of DDS, which has begun in this process and has no participant yet
/// @return why not; empty if it is so
/// @thread configuration only
std::string keep_on_loopback(int domain);

}  // namespace armature::ros2::internal
