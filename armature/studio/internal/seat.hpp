// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"
#include "armature/ride/origin.hpp"
#include "armature/studio/internal/key.hpp"

namespace armature::studio::internal {

/// The place of the robot's operator: one of those who have the studio open sits there, or nobody.
/// It is handed over or left, and never taken from somebody who is there; whose connection is gone,
/// or silent for 3 s, has left. Times are of the monotonic clock.
/// @thread any
class Seat {
 public:
  /// Somebody who has the studio open.
  struct Guest {
    std::int32_t number;  ///< of connections, from 1
    std::string who;      ///< as policies have it
    bool may_operate;     ///< commands the workbench
  };
  struct State {
    std::int32_t you = 0;
    std::int32_t holder = 0;  ///< 0: nobody
    std::vector<Guest> guests;
  };

  /// How things stand for somebody, who is known from then on.
  State state(const ride::Origin& guest, bool may_operate);

  /// The error: somebody else sits there.
  base::Result<void> take(const ride::Origin& guest);
  /// The error: `guest` does not sit there, or nobody who may operate has the number.
  base::Result<void> hand_over(const ride::Origin& guest, std::int32_t to);
  /// The error: `guest` does not sit there.
  base::Result<void> leave(const ride::Origin& guest);

  /// The key of who sits there, to be renewed as long as it is down.
  /// @return how long it has been; the error: `guest` does not sit there
  base::Result<base::Duration> hold_key(const ride::Origin& guest, bool down, base::Time now);

  /// May `guest` say what only the operator can know? The error says why not.
  base::Result<void> demand(const ride::Origin& guest);
  /// The same for what the robot does for its operator alone: the key has to be held, and has let
  /// through what it lets through.
  base::Result<void> use_key(const ride::Origin& guest, base::Time now);

  /// Looks who has gone.
  /// @return true if somebody came, went or sat down since it was asked last
  bool look(base::Time now);
  /// The number of who sits there; 0: nobody.
  std::int32_t holder() const;

 private:
  struct Known {
    Guest guest;
    ride::Origin origin;
    ride::Lifeline line;
  };

  Known* find(const ride::Origin& guest);
  const Known* sitting() const;
  void sit(std::int32_t number);
  void forget_lost();
  /// Nothing if `guest` sits there.
  base::Result<void> sits(const ride::Origin& guest) const;

  mutable std::mutex mutex_;  ///< of all below
  std::vector<Known> known_;
  std::int32_t last_number_ = 0;
  std::int32_t holder_ = 0;
  Key key_;
  bool changed_ = false;
};

}  // namespace armature::studio::internal
