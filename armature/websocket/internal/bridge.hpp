// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include <libwebsockets.h>

#include "armature/platform/sockets/stream_socket.hpp"
#include "armature/websocket/transport.hpp"

namespace armature::websocket::internal {

/// Carries bytes between a page's WebSocket and the socket whose other end the node has. Each way
/// it holds one piece, and reads on once that was taken: who is slow holds up its own sender only.
/// @thread that of the library
class Bridge {
 public:
  /// @param inner  this side's end
  Bridge(lws* page, std::unique_ptr<platform::StreamSocket> inner, const Options& options)
      : page_(page), inner_(std::move(inner)), options_(options) {}
  Bridge(const Bridge&) = delete;
  Bridge& operator=(const Bridge&) = delete;
  ~Bridge();

  /// Has the library watch this side's end; false if it cannot.
  bool watch(lws_vhost* vhost);

  // What the library tells. False: the connection is to be ended.
  bool page_sent(std::span<const std::byte> piece);
  bool page_takes();
  void node_sent();
  void node_takes();
  /// The library has closed its descriptor of this side's end.
  void no_longer_watched();

 private:
  bool refuse(lws_close_status why, const char* text);
  void expect_page_to_take();

  lws* const page_;
  lws* watched_ = nullptr;
  const std::unique_ptr<platform::StreamSocket> inner_;
  const Options& options_;
  std::vector<std::byte> to_node_;      ///< what the node has not taken
  std::vector<unsigned char> to_page_;  ///< behind the room that the library writes a header into
  bool node_gone_ = false;
  bool refused_ = false;  ///< the library says good-bye, in a time of its own
};

}  // namespace armature::websocket::internal
