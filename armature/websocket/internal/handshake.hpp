// SPDX-License-Identifier: Apache-2.0
#pragma once

// What opens a WebSocket, from the side that connects: RFC 6455, 4.1.

#include <cstdint>
#include <string>
#include <string_view>

namespace armature::websocket::internal {

/// By which programs and nodes know that they speak RIDE; pages name none.
inline constexpr std::string_view kSubprotocol = "ride";
/// What every answer begins with.
inline constexpr std::string_view kHttp = "HTTP/1.";

/// Where a WebSocket is, and what lets this side in there.
struct Door {
  std::string host;    ///< with its port, as the other side knows itself: `127.0.0.1:8080`
  std::string origin;  ///< the address of its pages, which is the only one that it lets in
  std::string token;   ///< that of its pages' address; empty: the certificate, or nothing
};

/// @param encrypted  over TLS
/// @param host  a name, or a numeric address without brackets
Door door_of(const std::string& host, std::uint16_t port, bool encrypted);

/// A request to open one.
/// @param key  16 bytes that nobody has sent before, in base64
std::string request_of(const Door& door, const std::string& key);

/// Why the answer to that request opens none; empty if it does.
/// @param head  all of it to the empty line
std::string problem_of(std::string_view head, const std::string& key);

/// Base64 of `bytes`.
std::string base64(std::string_view bytes);

}  // namespace armature::websocket::internal
