// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "armature/base/time.hpp"

namespace armature::ride {

namespace internal {
class Link;
}

/// The connection by which a message came, for what goes on after its answer and must not outlive
/// who asked for it.
class Origin {
 public:
  /// Of what no peer has sent: it is never lost.
  Origin() = default;
  /// @param who  as policies and logs say it: `operator@tls`
  Origin(std::weak_ptr<internal::Link> link, std::uint32_t connection, std::string who);

  /// True from the end of the connection on. A peer that only says that it sends no more counts as
  /// gone: a process that died looks the same.
  /// @thread any
  bool lost() const;
  const std::string& who() const { return who_; }

  /// Whether both are the same connection, not only the same peer.
  /// @thread any
  bool operator==(const Origin& other) const;

 private:
  friend class Lifeline;
  std::shared_ptr<internal::Link> link() const;

  bool from_peer_ = false;
  std::weak_ptr<internal::Link> link_;
  std::uint32_t connection_ = 0;  ///< which of the link's
  std::string who_;
};

/// Watches the connection of an Origin: who is silent is asked whether it lives, and is lost after
/// three times as long.
/// @thread one at a time
class Lifeline {
 public:
  explicit Lifeline(Origin origin, base::Duration silence = std::chrono::seconds(1))
      : origin_(std::move(origin)), silence_(silence) {}

  /// To be asked often.
  /// @param now  of the monotonic clock
  /// @return true once the peer has gone, or was silent for three times `silence`
  bool lost(base::Time now);
  const std::string& who() const { return origin_.who(); }

 private:
  Origin origin_;
  base::Duration silence_;
  std::uint64_t heard_ = 0;  ///< messages
  base::Time heard_at_ = base::Time::min();
  base::Time asked_at_ = base::Time::min();
};

}  // namespace armature::ride
