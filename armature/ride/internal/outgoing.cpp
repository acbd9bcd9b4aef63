// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/internal/outgoing.hpp"

#include <chrono>
#include <utility>

#include "armature/platform/clock.hpp"

namespace armature::ride::internal {
namespace {

/// A message that comes so soon after another waits for those that follow.
constexpr base::Duration kMoment = std::chrono::microseconds(20);
/// So much is sent by the one who gathers.
constexpr std::size_t kMostGathered = 8 * 1024;

}  // namespace

bool Outgoing::append_event(std::uint32_t subscription, std::span<const std::byte> message) {
  const std::size_t start = bytes_.size();
  const Priority priority{static_cast<std::uint8_t>(load<std::uint32_t>(message.data() + 4))};
  if (!append(priority, [&](Body& bytes) { bytes.append(message); })) return false;
  for (std::size_t at = start; at < bytes_.size();) {
    std::byte* const header = bytes_.data() + at;
    store(header + 12, subscription);
    at += load<std::uint16_t>(header + 10);
  }
  return true;
}

Outgoing::Gather Outgoing::gather(base::Time now) {
  const bool alone = !gathers_ && now - last_sent_ >= kMoment;
  if (alone || unsent() >= kMostGathered) {
    last_sent_ = now;
    gathered_since_ = now;
    return Gather::kSend;
  }
  if (gathers_) return Gather::kWait;
  gathers_ = true;
  gathered_since_ = now;
  return Gather::kWaitAnew;
}

/// What is urgent takes along what goes before it on the same connection.
void Outgoing::tell_level(Connection& connection) {
  constexpr int kLevels = Connection::kMostUrgentLevel + 1;
  const int level = most_urgent_.level * kLevels / 256;
  if (level != std::exchange(level_, level)) connection.set_level(level);
}

Progress Outgoing::transmit(Connection& connection) {
  tell_level(connection);
  const std::size_t before = sent_;
  Progress progress = Progress::kDone;
  while (sent_ < bytes_.size()) {
    std::size_t sent = 0;
    progress = connection.send(bytes_.bytes().subspan(sent_), sent);
    if (progress == Progress::kGone) return progress;
    if (progress != Progress::kDone) {
      if (before != sent_ || stuck_since_ == base::Time{}) stuck_since_ = platform::monotonic_now();
      blocked_ = true;
      break;
    }
    sent_ += sent;
  }
  if (sent_ == bytes_.size()) {
    stuck_since_ = {};
    most_urgent_ = {};
  }
  forget_sent();
  return progress;
}

/// What is left is moved seldom: the other side may take much in small pieces.
void Outgoing::forget_sent() {
  if (sent_ != bytes_.size() && sent_ < bytes_.size() / 2) return;
  bytes_.erase_front(std::exchange(sent_, 0));
  bytes_.shrink(kMostKept);
}

bool Outgoing::unblock() { return std::exchange(blocked_, false); }

bool Outgoing::is_stuck(base::Time now, base::Duration limit) const {
  return blocked_ && stuck_since_ != base::Time{} && now - stuck_since_ >= limit;
}

void Outgoing::clear() {
  bytes_.clear();
  bytes_.shrink(0);
  sent_ = 0;
  most_urgent_ = {};
  level_ = 0;
  blocked_ = false;
  gathers_ = false;
}

}  // namespace armature::ride::internal
