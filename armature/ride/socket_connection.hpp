// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "armature/platform/sockets/stream_socket.hpp"
#include "armature/ride/transport.hpp"

namespace armature::ride {

/// A connection whose bytes go through `socket` as they are.
/// @param identity  what the other end has proven to be; empty: nothing
std::unique_ptr<Connection> make_connection(std::unique_ptr<platform::StreamSocket> socket,
                                            std::string identity = {});

}  // namespace armature::ride
