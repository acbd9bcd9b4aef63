// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include <libwebsockets.h>

#include "armature/base/time.hpp"
#include "armature/websocket/messages.hpp"

namespace armature::websocket::internal {

/// Carries messages between a client's WebSocket and whoever answers it.
/// @thread that of the library
class Correspondent {
 public:
  /// @param client  as `messages` knows it
  Correspondent(lws* socket, Messages& messages, std::uint32_t client, base::Duration time_to_take)
      : socket_(socket), messages_(messages), client_(client), time_to_take_(time_to_take) {}
  Correspondent(const Correspondent&) = delete;
  Correspondent& operator=(const Correspondent&) = delete;
  ~Correspondent() { messages_.leave(client_); }

  // What the library tells. False: the connection is to be ended.
  bool sent(std::span<const std::byte> piece);
  bool takes();
  /// Something may be there for the client, or more of it may be read.
  void look();

 private:
  bool refuse(lws_close_status why, std::string text);

  lws* const socket_;
  Messages& messages_;
  const std::uint32_t client_;
  const base::Duration time_to_take_;
  std::string message_;    ///< of the client, as far as it has come
  bool held_up_ = false;   ///< nothing of the client is read
  bool expected_ = false;  ///< the library tells when the client has taken what was written
  bool refused_ = false;   ///< the library says good-bye, in a time of its own
};

}  // namespace armature::websocket::internal
