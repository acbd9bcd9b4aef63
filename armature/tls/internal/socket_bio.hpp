// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "armature/platform/sockets/stream_socket.hpp"
#include "armature/tls/internal/openssl.hpp"

namespace armature::tls::internal {

/// What a session sends and receives through, which is not to wait and not to raise signals.
struct Wire {
  explicit Wire(std::unique_ptr<platform::StreamSocket> stream) : socket(std::move(stream)) {}

  const std::unique_ptr<platform::StreamSocket> socket;
  std::optional<unsigned char> first;  ///< the first byte that came: tells TLS from all else
  bool ended = false;                  ///< nothing more comes
  bool failed = false;                 ///< the socket says why
};

/// @param wire  outlives it
BioPointer make_bio(Wire& wire);

}  // namespace armature::tls::internal
