// SPDX-License-Identifier: Apache-2.0
#include "armature/websocket/internal/bridge.hpp"

#include <algorithm>
#include <string_view>

namespace armature::websocket::internal {
namespace {

using platform::StreamStatus;

/// Of the node's bytes that go in one frame.
constexpr std::size_t kPiece = 16 * 1024;
constexpr auto kSlow = static_cast<pending_timeout>(PENDING_TIMEOUT_USER_REASON_BASE);

}  // namespace

Bridge::~Bridge() {
  if (watched_ == nullptr) return;
  lws_set_opaque_user_data(watched_, nullptr);
  lws_set_timeout(watched_, kSlow, LWS_TO_KILL_ASYNC);
}

bool Bridge::watch(lws_vhost* vhost) {
  lws_sock_file_fd_type descriptor{};
  descriptor.filefd = platform::another_handle(inner_->handle());
  if (descriptor.filefd < 0) return false;
  watched_ =
      lws_adopt_descriptor_vhost(vhost, LWS_ADOPT_RAW_FILE_DESC, descriptor, "ride", nullptr);
  if (watched_ == nullptr) return false;
  lws_set_opaque_user_data(watched_, this);
  return true;
}

bool Bridge::refuse(lws_close_status why, const char* text) {
  refused_ = true;
  inner_->shut_down();
  std::string reason = text;
  lws_close_reason(page_, why, reinterpret_cast<unsigned char*>(reason.data()), reason.size());
  return false;
}

bool Bridge::page_sent(std::span<const std::byte> piece) {
  if (refused_) return false;
  if (lws_frame_is_binary(page_) == 0) {
    return refuse(LWS_CLOSE_STATUS_UNACCEPTABLE_OPCODE, "frames are binary");
  }
  if (piece.size() + lws_remaining_packet_payload(page_) > options_.frame_bytes) {
    return refuse(LWS_CLOSE_STATUS_MESSAGE_TOO_LARGE, "a frame is too large");
  }
  to_node_.insert(to_node_.end(), piece.begin(), piece.end());
  node_takes();
  return !node_gone_;
}

void Bridge::node_takes() {
  const bool held_up = !to_node_.empty();
  while (!to_node_.empty()) {
    std::size_t sent = 0;
    const StreamStatus status = inner_->send(to_node_, sent);
    if (status == StreamStatus::kGone) {
      node_gone_ = true;
      to_node_.clear();
    }
    if (status != StreamStatus::kDone) break;
    to_node_.erase(to_node_.begin(), to_node_.begin() + static_cast<std::ptrdiff_t>(sent));
  }
  if (!to_node_.empty()) {
    lws_rx_flow_control(page_, 0);
    if (watched_ != nullptr) lws_callback_on_writable(watched_);
  } else if (held_up) {
    lws_rx_flow_control(page_, 1);
  }
}

void Bridge::node_sent() {
  if (!to_page_.empty()) return;
  to_page_.resize(LWS_PRE + kPiece);
  std::size_t size = 0;
  const StreamStatus status =
      inner_->receive(std::as_writable_bytes(std::span(to_page_).subspan(LWS_PRE)), size);
  to_page_.resize(status == StreamStatus::kDone ? LWS_PRE + size : 0);
  if (status == StreamStatus::kLater) return;
  node_gone_ = status == StreamStatus::kGone;
  if (watched_ != nullptr) lws_rx_flow_control(watched_, 0);
  expect_page_to_take();
}

/// Of a node that has left, which may have sent something before.
void Bridge::no_longer_watched() {
  watched_ = nullptr;
  node_sent();
}

/// The library tells when the page has taken all that was written before.
void Bridge::expect_page_to_take() {
  const auto limit = std::chrono::ceil<std::chrono::seconds>(options_.time_to_take);
  lws_set_timeout(page_, kSlow, static_cast<int>(limit.count()));
  lws_callback_on_writable(page_);
}

bool Bridge::page_takes() {
  if (refused_) return false;
  lws_set_timeout(page_, NO_PENDING_TIMEOUT, 0);
  if (!to_page_.empty()) {
    const std::size_t size = to_page_.size() - LWS_PRE;
    const int written = lws_write(page_, to_page_.data() + LWS_PRE, size, LWS_WRITE_BINARY);
    to_page_.clear();
    if (written < static_cast<int>(size)) return false;
    expect_page_to_take();
    return true;
  }
  if (node_gone_) return refuse(LWS_CLOSE_STATUS_GOINGAWAY, "the application has left");
  if (watched_ == nullptr) {
    node_sent();
  } else {
    lws_rx_flow_control(watched_, 1);
  }
  return true;
}

}  // namespace armature::websocket::internal
