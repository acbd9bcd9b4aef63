// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "armature/ride/internal/waiting.hpp"

namespace armature::ride::internal {

/// Whose turn it is among the connections that have sent something. The most urgent message is
/// dispatched first; among equally urgent ones connections that have sent a single small message
/// come first, and the others take turns, one message each. Of eight messages one is of whoever has
/// its turn by order alone: who floods a node, with urgent messages too, holds up the others for as
/// long as there are connections, not messages.
/// @thread one at a time
class Pending {
 public:
  struct Entry {
    Link* link;
    Message message;
  };

  bool empty() const { return waiting_.empty(); }

  void push(Waiting& whose, const Message& message) {
    if (whose.empty()) waiting_.push_back(&whose);
    whose.push(message);
    if (holds_large_ && whose.has_large()) hold_large();
  }

  /// Connections that have sent something large have no turn until `release_large`.
  void hold_large() {
    holds_large_ = true;
    for (std::size_t at = waiting_.size(); at-- != 0;) {
      if (!waiting_[at]->has_large()) continue;
      held_.push_back(waiting_[at]);
      remove(at);
    }
  }
  void release_large() {
    holds_large_ = false;
    waiting_.insert(waiting_.end(), held_.begin(), held_.end());
    held_.clear();
  }
  bool holds_large() const { return holds_large_; }

  /// There is one. Its body lies where it was until its connection's next `push`.
  Entry pop() {
    const bool by_order = ++count_ % kOneOf == 0;
    std::size_t& turn = by_order ? order_ : turn_;
    const std::size_t at = by_order ? order_ % waiting_.size() : most_urgent();
    turn = at + 1;
    Waiting& whose = *waiting_[at];
    const Message message = whose.pop();
    if (whose.empty()) remove(at);
    return {whose.link, message};
  }

 private:
  static constexpr std::size_t kOneOf = 8;

  /// Of several the one after whoever had its turn last.
  std::size_t most_urgent() const {
    std::size_t found = turn_ % waiting_.size();
    for (std::size_t k = 1; k < waiting_.size(); ++k) {
      const std::size_t at = (turn_ + k) % waiting_.size();
      if (comes_before(*waiting_[at], *waiting_[found])) found = at;
    }
    return found;
  }
  static bool comes_before(const Waiting& one, const Waiting& other) {
    if (one.urgency() != other.urgency()) return one.urgency() > other.urgency();
    return one.is_single() && !other.is_single();
  }

  void remove(std::size_t at) {
    waiting_.erase(waiting_.begin() + static_cast<std::ptrdiff_t>(at));
    if (turn_ > at) --turn_;
    if (order_ > at) --order_;
  }

  std::vector<Waiting*> waiting_;  ///< none of them empty
  std::vector<Waiting*> held_;     ///< neither
  bool holds_large_ = false;
  std::size_t turn_ = 0;
  std::size_t order_ = 0;
  std::size_t count_ = 0;
};

}  // namespace armature::ride::internal
