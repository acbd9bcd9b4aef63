// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
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
    kept_.push_back({&link, message.header, bytes_.size(), message.body.size()});
    bytes_.append(message.body);
  }

  /// Gives them to `take(Link&, const Message&)`, and forgets them.
  template <typename Take>
  void take_all(const Take& take) {
    for (const Kept& kept : kept_) {
      take(*kept.link, Message{kept.header, bytes_.bytes().subspan(kept.begin, kept.size)});
    }
    kept_.clear();
    bytes_.clear();
    bytes_.shrink(2 * kMostBytes);
  }

 private:
  static constexpr std::size_t kMostBytes = 1024 * 1024;
  static constexpr std::size_t kMostMessages = 64 * 1024;

  struct Kept {
    Link* link;
    Header header;
    std::size_t begin;
    std::size_t size;
  };

  std::vector<Kept> kept_;
  Body bytes_;
};

}  // namespace armature::ride::internal
