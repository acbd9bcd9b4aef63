// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "armature/foxglove/internal/protocol.hpp"
#include "armature/websocket/messages.hpp"

namespace armature::foxglove::internal {

/// The way to a client. Values are lost if it does not take them in time; what it is told is not.
class Outlet {
 public:
  Outlet(websocket::Messages& messages, std::uint32_t client)
      : messages_(messages), client_(client) {}

  void tell(std::string text) { messages_.send(client_, std::move(text)); }
  void tell_binary(std::string binary) { messages_.send_binary(client_, std::move(binary)); }
  void warn(const std::string& text) { tell(status(Level::kWarning, text)); }
  void offer(std::string binary) { lost_ += messages_.offer(client_, std::move(binary)) ? 0u : 1u; }
  /// Values that were lost until now.
  std::uint64_t lost() const { return lost_; }

 private:
  websocket::Messages& messages_;
  const std::uint32_t client_;
  std::uint64_t lost_ = 0;
};

}  // namespace armature::foxglove::internal
