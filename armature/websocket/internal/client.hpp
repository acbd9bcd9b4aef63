// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "armature/ride/transport.hpp"
#include "armature/websocket/internal/handshake.hpp"
#include "armature/websocket/internal/unframer.hpp"

namespace armature::websocket::internal {

/// The end of a WebSocket that has connected (RFC 6455), over a connection of TCP or TLS. Bytes go
/// in binary frames, whose borders mean nothing: what is sent is announced as one frame, of which
/// any part may go at a time.
class ClientConnection final : public ride::Connection {
 public:
  /// @param under  is being connected
  ClientConnection(std::unique_ptr<ride::Connection> under, Door door);
  ~ClientConnection() override;

  int handle() const override { return under_->handle(); }
  ride::Progress establish() override;
  bool establishes_slowly() const override { return under_->establishes_slowly(); }
  ride::Progress send(std::span<const std::byte> bytes, std::size_t& sent) override;
  ride::Progress receive(std::span<std::byte> room, std::size_t& size) override;
  ride::Progress wait_and_receive(std::span<std::byte> room, std::size_t& size,
                                  base::Duration limit) override;
  void set_level(int level) override { under_->set_level(level); }
  void shut_down() override;
  std::string other_end() const override { return under_->other_end(); }
  std::string identity() const override { return under_->identity(); }
  std::string problem() const override;

 private:
  enum class State { kConnecting, kAsking, kAnswered, kUp, kGone };

  ride::Progress gone(std::string problem);
  ride::Progress ask();
  ride::Progress take_answer();
  ride::Progress send_some(std::span<const std::byte> bytes, std::size_t& sent);
  ride::Progress send_control();
  void begin_frame(std::size_t size);
  void owe_pong();
  void say_good_bye();
  ride::Progress unframed(ride::Progress progress, std::span<std::byte> raw, std::size_t& size);
  std::array<std::byte, 4> next_mask();

  const std::unique_ptr<ride::Connection> under_;
  const Door door_;
  std::string key_;
  std::string text_;  ///< of the request what is left to send; then of the answer what has come
  Unframer unframer_;

  mutable std::mutex mutex_;  ///< of what follows: who receives owes pongs
  State state_ = State::kConnecting;
  std::string problem_;
  std::uint64_t mask_state_;
  std::vector<std::byte> piece_;  ///< a frame's header and masked bytes, as they go down
  std::array<std::byte, 8> head_{};
  std::size_t head_size_ = 0;  ///< of the frame that has begun
  std::size_t head_sent_ = 0;
  std::size_t frame_left_ = 0;  ///< of its payload
  std::array<std::byte, 4> mask_{};
  std::size_t mask_at_ = 0;
  std::vector<std::byte> control_;  ///< a control frame that has to go before the next frame
};

}  // namespace armature::websocket::internal
