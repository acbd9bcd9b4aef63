// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/base/time.hpp"
#include "armature/ride/internal/node/dispatcher.hpp"
#include "armature/ride/internal/node/node_core.hpp"
#include "armature/ride/internal/pending.hpp"

namespace armature::ride::internal {

/// The messages that wait to be dispatched, one after the other in fair turns, and for how long at
/// a time. One that takes long is followed by a pause, in which there is time for all others.
/// @thread the node's
class Turns {
 public:
  Turns(NodeCore& core, Dispatcher& dispatcher) : core_(core), dispatcher_(dispatcher) {}

  void push(Link& link, const Message& message) { pending_.push(link.waiting, message); }
  bool empty() const { return pending_.empty(); }
  /// A message is being dispatched, and stays where it lies.
  bool dispatches() const { return dispatches_; }

  /// Dispatches what waits, until others may have come meanwhile.
  /// @param alone  there is no other connection to have time for
  void take(bool alone);
  /// Ends a pause that is over.
  void look_at_timers();
  /// Dispatches none of them any more.
  void refuse_all(const char* why);

 private:
  void dispatch_large(Link& link, const Message& message, bool alone);
  void dispatch(Link& link, const Message& message);

  NodeCore& core_;
  Dispatcher& dispatcher_;
  Pending pending_;
  base::Time large_from_{};  ///< if large messages are held
  bool dispatches_ = false;
};

}  // namespace armature::ride::internal
