// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/origin.hpp"

#include <utility>

#include "armature/ride/internal/link.hpp"

namespace armature::ride {

Origin::Origin(std::weak_ptr<internal::Link> link, std::uint32_t connection, std::string who)
    : from_peer_(true), link_(std::move(link)), connection_(connection), who_(std::move(who)) {}

/// nullptr if the connection has ended.
std::shared_ptr<internal::Link> Origin::link() const {
  std::shared_ptr<internal::Link> link = link_.lock();
  const bool lives = link != nullptr && link->connection_number() == connection_ && link->open() &&
                     !link->is_leaving();
  return lives ? link : nullptr;
}

bool Origin::lost() const { return from_peer_ && link() == nullptr; }

bool Origin::operator==(const Origin& other) const {
  const bool same_link = !link_.owner_before(other.link_) && !other.link_.owner_before(link_);
  return from_peer_ == other.from_peer_ && same_link && connection_ == other.connection_;
}

bool Lifeline::lost(base::Time now) {
  if (!origin_.from_peer_) return false;
  const std::shared_ptr<internal::Link> link = origin_.link();
  if (link == nullptr) return true;
  const std::uint64_t heard = link->received();
  if (heard_at_ == base::Time::min() || heard != heard_) {
    heard_ = heard;
    heard_at_ = asked_at_ = now;
    return false;
  }
  if (now - asked_at_ >= silence_) {
    asked_at_ = now;
    link->send_control(0, {Code::kPing, 0, 0, 0, {}});
  }
  return now - heard_at_ >= 3 * silence_;
}

}  // namespace armature::ride
