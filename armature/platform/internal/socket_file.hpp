// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include <sys/un.h>

#include "armature/base/result.hpp"

namespace armature::platform::internal {

/// The address of a socket file; none if the path is empty or too long.
std::optional<sockaddr_un> address_of(const std::string& path);

/// What to say about a path that is none.
base::Error no_address(const std::string& path);

/// Removes a socket file that a server has left which is no more. The error says who serves there,
/// or that it is no socket.
/// @param type  SOCK_STREAM or SOCK_SEQPACKET
base::Result<void> make_room(const std::string& path, int type);

}  // namespace armature::platform::internal
