// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "armature/ride/internal/assembler.hpp"

namespace armature::ride::internal {

class Link;

/// Messages that a caller has received for the node's thread, in their order. Keeps its memory.
/// @thread one at a time
class HandedOver {
 public:
  bool full() const { return bytes_.size() >= kMostBytes || kept_.size() >= kMostMessages; }

  void push(Link& link, const Message& message) {
    if (message.whole != nullptr) {
      wholes_.push_back(std::move(*message.whole));
      kept_.push_back({&link, message.header, wholes_.size() - 1, message.body.size(), true});
      return;
    }
    bytes_.append(message.body);
    kept_.push_back(
        {&link, message.header, bytes_.size() - message.body.size(), message.body.size(), false});
  }

  /// Gives them to `take(Link&, const Message&)`, and forgets them.
  template <typename Take>
  void take_all(const Take& take) {
    for (const Kept& kept : kept_) {
      Body* const whole = kept.is_whole ? &wholes_[kept.begin] : nullptr;
      const auto body =
          whole != nullptr ? whole->bytes() : bytes_.bytes().subspan(kept.begin, kept.size);
      take(*kept.link, Message{kept.header, body, whole});
    }
    kept_.clear();
    wholes_.clear();
    bytes_.clear();
    bytes_.shrink(2 * kMostBytes);
  }

 private:
  static constexpr std::size_t kMostBytes = 1024 * 1024;
  static constexpr std::size_t kMostMessages = 64 * 1024;

  struct Kept {
    Link* link;
    Header header;
    std::size_t begin;  ///< in `bytes_`, or which of `wholes_`
    std::size_t size;
    bool is_whole;
  };

  std::vector<Kept> kept_;
  Body bytes_;
  std::vector<Body> wholes_;  ///< those that came in several messages
};

}  // namespace armature::ride::internal
