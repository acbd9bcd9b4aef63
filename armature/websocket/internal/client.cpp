// SPDX-License-Identifier: Apache-2.0
#include "armature/websocket/internal/client.hpp"

#include <algorithm>
#include <random>
#include <utility>

#include "armature/platform/clock.hpp"

namespace armature::websocket::internal {
namespace {

using ride::Progress;

/// Of the payload of a frame.
constexpr std::size_t kMostPayload = 16 * 1024;
constexpr std::size_t kMostHead = 8;  ///< of such a frame
constexpr std::size_t kMostAnswerBytes = 8 * 1024;
constexpr std::size_t kSmallPayload = 125;
constexpr auto kFinal = std::byte{0x80};
constexpr auto kMasked = std::byte{0x80};
constexpr auto kBinaryFrame = std::byte{2};
constexpr auto kCloseFrame = std::byte{8};
constexpr auto kPongFrame = std::byte{10};

std::uint64_t seed() {
  std::random_device device;
  return static_cast<std::uint64_t>(device()) << 32 | device();
}

std::string random_key() {
  std::random_device device;
  std::string bytes(16, '\0');
  for (char& each : bytes) each = static_cast<char>(device() & 0xff);
  return base64(bytes);
}

}  // namespace

ClientConnection::ClientConnection(std::unique_ptr<ride::Connection> under, Door door)
    : under_(std::move(under)),
      door_(std::move(door)),
      key_(random_key()),
      text_(request_of(door_, key_)),
      mask_state_(seed()),
      piece_(kMostHead + kMostPayload) {
  control_.reserve(kMostHead + kSmallPayload);
}

ClientConnection::~ClientConnection() { ClientConnection::shut_down(); }

Progress ClientConnection::gone(std::string problem) {
  state_ = State::kGone;
  problem_ = std::move(problem);
  return Progress::kGone;
}

std::string ClientConnection::problem() const {
  const std::lock_guard lock(mutex_);
  return problem_;
}

// --- opening it ----------------------------------------------------------------------------------

Progress ClientConnection::establish() {
  const std::lock_guard lock(mutex_);
  if (state_ == State::kConnecting) {
    const Progress progress = under_->establish();
    if (progress == Progress::kGone) return gone(under_->problem());
    if (progress != Progress::kDone) return progress;
    state_ = State::kAsking;
  }
  if (state_ == State::kAsking) {
    if (const Progress progress = ask(); progress != Progress::kDone) return progress;
  }
  if (state_ == State::kAnswered) return take_answer();
  return state_ == State::kUp ? Progress::kDone : Progress::kGone;
}

Progress ClientConnection::ask() {
  while (!text_.empty()) {
    std::size_t sent = 0;
    const Progress progress = under_->send(std::as_bytes(std::span(text_)), sent);
    if (progress == Progress::kGone) return gone(under_->problem());
    if (progress != Progress::kDone) return progress;
    text_.erase(0, sent);
  }
  state_ = State::kAnswered;
  return Progress::kDone;
}

/// Byte by byte: what comes behind the answer stays where a poller sees it.
Progress ClientConnection::take_answer() {
  while (!text_.ends_with("\r\n\r\n")) {
    std::byte next{};
    std::size_t size = 0;
    const Progress progress = under_->receive(std::span(&next, 1), size);
    if (progress == Progress::kGone) {
      return gone((text_.empty() ? "it answered nothing: " : "it broke off its answer: ") +
                  under_->problem());
    }
    if (progress != Progress::kDone) return progress;
    text_ += static_cast<char>(next);
    if (!kHttp.starts_with(std::string_view(text_).substr(0, kHttp.size()))) {
      return gone("no WebSocket is there: what it sent is no answer of HTTP");
    }
    if (text_.size() > kMostAnswerBytes) return gone("its answer has no end");
  }
  if (std::string problem = problem_of(text_, key_); !problem.empty()) {
    return gone(std::move(problem));
  }
  text_.clear();
  state_ = State::kUp;
  return Progress::kDone;
}

// --- sending -------------------------------------------------------------------------------------

/// By which no bytes of this side look to whoever stands between like what somebody wished: drawn
/// anew for each connection, and not again for each frame, which would be a call of the system.
std::array<std::byte, 4> ClientConnection::next_mask() {
  mask_state_ += 0x9e3779b97f4a7c15;  // splitmix64, by Steele, Lea and Flood
  std::uint64_t mixed = mask_state_;
  mixed = (mixed ^ mixed >> 30) * 0xbf58476d1ce4e5b9;
  mixed = (mixed ^ mixed >> 27) * 0x94d049bb133111eb;
  mixed ^= mixed >> 31;
  std::array<std::byte, 4> mask{};
  for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = static_cast<std::byte>(mixed >> (8 * i));
  return mask;
}

void ClientConnection::begin_frame(std::size_t size) {
  mask_ = next_mask();
  mask_at_ = 0;
  frame_left_ = size;
  head_[0] = kFinal | kBinaryFrame;
  head_size_ = 2;
  if (size <= kSmallPayload) {
    head_[1] = kMasked | static_cast<std::byte>(size);
  } else {
    head_[1] = kMasked | std::byte{126};
    head_[head_size_++] = static_cast<std::byte>(size >> 8);
    head_[head_size_++] = static_cast<std::byte>(size & 0xff);
  }
  for (const std::byte each : mask_) head_[head_size_++] = each;
  head_sent_ = 0;
}

Progress ClientConnection::send(std::span<const std::byte> bytes, std::size_t& sent) {
  const std::lock_guard lock(mutex_);
  sent = 0;
  if (state_ != State::kUp) return Progress::kGone;
  while (sent == 0 && !bytes.empty()) {
    if (const Progress progress = send_control(); progress != Progress::kDone) return progress;
    const Progress progress = send_some(bytes, sent);
    if (progress == Progress::kGone) return gone(under_->problem());
    if (progress != Progress::kDone) return progress;
  }
  return Progress::kDone;
}

/// A frame that has begun goes on with the bytes that come next, and looks the same if it is tried
/// again: TLS has perhaps encrypted it already.
Progress ClientConnection::send_some(std::span<const std::byte> bytes, std::size_t& sent) {
  if (frame_left_ == 0) begin_frame(std::min(bytes.size(), kMostPayload));
  const std::size_t head = head_size_ - head_sent_;
  const std::size_t payload = std::min(bytes.size(), frame_left_);
  std::copy_n(head_.begin() + static_cast<std::ptrdiff_t>(head_sent_), head, piece_.begin());
  for (std::size_t i = 0; i < payload; ++i) {
    piece_[head + i] = bytes[i] ^ mask_[(mask_at_ + i) % mask_.size()];
  }
  std::size_t taken = 0;
  const Progress progress = under_->send(std::span(piece_).first(head + payload), taken);
  if (progress != Progress::kDone) return progress;
  const std::size_t of_head = std::min(taken, head);
  head_sent_ += of_head;
  sent = taken - of_head;
  frame_left_ -= sent;
  mask_at_ += sent;
  return Progress::kDone;
}

/// Between frames.
Progress ClientConnection::send_control() {
  if (frame_left_ > 0) return Progress::kDone;
  while (!control_.empty()) {
    std::size_t sent = 0;
    const Progress progress = under_->send(control_, sent);
    if (progress == Progress::kGone) return gone(under_->problem());
    if (progress != Progress::kDone) return progress;
    control_.erase(control_.begin(), control_.begin() + static_cast<std::ptrdiff_t>(sent));
  }
  return Progress::kDone;
}

// --- receiving -----------------------------------------------------------------------------------

void ClientConnection::owe_pong() {
  std::array<std::byte, kSmallPayload> payload{};
  std::size_t size = 0;
  if (!unframer_.take_ping(payload, size)) return;
  const std::lock_guard lock(mutex_);
  if (state_ != State::kUp || !control_.empty()) return;  // one that waits stands for both
  const auto mask = next_mask();
  control_.push_back(kFinal | kPongFrame);
  control_.push_back(kMasked | static_cast<std::byte>(size));
  control_.insert(control_.end(), mask.begin(), mask.end());
  for (std::size_t i = 0; i < size; ++i) control_.push_back(payload[i] ^ mask[i % mask.size()]);
  static_cast<void>(send_control());
}

/// What came of bytes that have come: kWantRead if there is nothing in them for the receiver.
Progress ClientConnection::unframed(Progress progress, std::span<std::byte> raw,
                                    std::size_t& size) {
  size = 0;
  if (progress == Progress::kDone) {
    size = unframer_.unframe(raw);
    owe_pong();
    if (size > 0) return Progress::kDone;
    if (unframer_.problem().empty() && !unframer_.ended()) return Progress::kWantRead;
  } else if (progress != Progress::kGone) {
    return progress;
  }
  const std::lock_guard lock(mutex_);
  if (!unframer_.problem().empty()) return gone(unframer_.problem());
  if (!unframer_.ended()) return gone(under_->problem());
  const std::string reason = unframer_.reason();
  return gone("the other side has ended it" + (reason.empty() ? "" : ": " + reason));
}

Progress ClientConnection::receive(std::span<std::byte> room, std::size_t& size) {
  const bool over = unframer_.ended() || !unframer_.problem().empty();
  while (true) {
    std::size_t raw = 0;
    const Progress got = over ? Progress::kGone : under_->receive(room, raw);
    const Progress progress = unframed(got, room.first(raw), size);
    if (got != Progress::kDone || progress != Progress::kWantRead) return progress;
  }
}

Progress ClientConnection::wait_and_receive(std::span<std::byte> room, std::size_t& size,
                                            base::Duration limit) {
  const base::Time end = base::later(platform::monotonic_now(), limit);
  while (true) {
    if (const Progress progress = receive(room, size); progress != Progress::kWantRead) {
      return progress;
    }
    const base::Duration left = end - platform::monotonic_now();
    if (left <= base::Duration::zero()) return Progress::kWantRead;
    std::size_t raw = 0;
    const Progress got = under_->wait_and_receive(room, raw, left);
    const Progress progress = unframed(got, room.first(raw), size);
    if (got != Progress::kDone || progress != Progress::kWantRead) return progress;
  }
}

// --- ending it -----------------------------------------------------------------------------------

/// 1000: all is done. Said if that can be sent without waiting.
void ClientConnection::say_good_bye() {
  if (state_ != State::kUp || frame_left_ > 0 || !control_.empty()) return;
  const auto mask = next_mask();
  control_ = {kFinal | kCloseFrame, kMasked | std::byte{2}};
  control_.insert(control_.end(), mask.begin(), mask.end());
  control_.push_back(std::byte{0x03} ^ mask[0]);
  control_.push_back(std::byte{0xe8} ^ mask[1]);
  static_cast<void>(send_control());
  control_.clear();
}

void ClientConnection::shut_down() {
  {
    const std::lock_guard lock(mutex_);
    say_good_bye();
    if (state_ != State::kGone) gone("it was ended here");
  }
  under_->shut_down();
}

}  // namespace armature::websocket::internal
