// SPDX-License-Identifier: Apache-2.0
#include "armature/websocket/internal/correspondent.hpp"

#include <chrono>
#include <optional>
#include <utility>

namespace armature::websocket::internal {
namespace {

constexpr auto kTakesNothing = static_cast<pending_timeout>(PENDING_TIMEOUT_USER_REASON_BASE);

}  // namespace

bool Correspondent::refuse(lws_close_status why, std::string text) {
  refused_ = true;
  lws_close_reason(socket_, why, reinterpret_cast<unsigned char*>(text.data()), text.size());
  return false;
}

bool Correspondent::sent(std::span<const std::byte> piece) {
  if (refused_) return false;
  const std::size_t rest = lws_remaining_packet_payload(socket_);
  if (message_.size() + piece.size() + rest > messages_.options().message_bytes) {
    return refuse(LWS_CLOSE_STATUS_MESSAGE_TOO_LARGE, "a message is too large");
  }
  message_.append(reinterpret_cast<const char*>(piece.data()), piece.size());
  if (rest > 0 || lws_is_final_fragment(socket_) == 0) return true;
  messages_.receive(client_, lws_frame_is_binary(socket_) == 0, std::exchange(message_, {}));
  look();
  return true;
}

void Correspondent::look() {
  if (refused_) return;
  if (std::exchange(held_up_, !messages_.reads(client_)) != held_up_) {
    lws_rx_flow_control(socket_, held_up_ ? 0 : 1);
  }
  if (messages_.gives_up(client_))
    return lws_set_timeout(socket_, kTakesNothing, LWS_TO_KILL_ASYNC);
  if (expected_ || !messages_.has_next(client_)) return;
  expected_ = true;
  const auto limit = std::chrono::ceil<std::chrono::seconds>(time_to_take_);
  lws_set_timeout(socket_, kTakesNothing, static_cast<int>(limit.count()));
  lws_callback_on_writable(socket_);
}

bool Correspondent::takes() {
  if (refused_) return false;
  expected_ = false;
  lws_set_timeout(socket_, NO_PENDING_TIMEOUT, 0);
  const std::optional<Outgoing> message = messages_.next(client_);
  if (!message) return true;
  std::string room(LWS_PRE, '\0');
  room += message->content;
  const std::size_t size = message->content.size();
  const int written = lws_write(socket_, reinterpret_cast<unsigned char*>(room.data()) + LWS_PRE,
                                size, message->text ? LWS_WRITE_TEXT : LWS_WRITE_BINARY);
  if (written < static_cast<int>(size)) return false;
  look();
  return true;
}

}  // namespace armature::websocket::internal
