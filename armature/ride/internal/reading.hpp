// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace armature::ride::internal {

/// Which thread reads a connection: the I/O thread, or a caller who waits for its answer. A caller
/// takes over without a word, and the I/O thread takes back lazily. Guarded by the link's lock.
class Reading {
 public:
  bool is_of_node() const { return reader_ == Reader::kNode; }
  bool is_of_caller() const { return reader_ == Reader::kCaller; }

  /// Where events are subscribed a caller gives back at once.
  void set_listens(bool listens) { listens_ = listens; }
  bool listens() const { return listens_; }

  void give_to_node() { reader_ = Reader::kNode; }
  /// The I/O thread reads if nobody does.
  /// @return whether nobody did
  bool claim_for_node() {
    if (reader_ != Reader::kNobody) return false;
    reader_ = Reader::kNode;
    return true;
  }
  void give_to_caller() {
    ++takeovers_;
    reader_ = Reader::kCaller;
  }
  void give_to_nobody() { reader_ = Reader::kNobody; }

  /// Whether the I/O thread looks after it until it has reading back.
  bool returns() const { return returns_; }
  void begin_return() { returns_ = true; }
  /// It looks after it.
  /// @return whether nobody reads, nor a caller has since it looked last: it reads itself now
  bool take_back() {
    const bool idle = reader_ == Reader::kNobody && takeovers_ == takeovers_seen_;
    if (idle) reader_ = Reader::kNode;
    takeovers_seen_ = takeovers_;
    returns_ = reader_ != Reader::kNode;
    return idle;
  }

 private:
  enum class Reader : std::uint8_t { kNode, kCaller, kNobody };

  Reader reader_ = Reader::kNode;
  bool listens_ = false;
  bool returns_ = false;
  std::uint32_t takeovers_ = 0;
  std::uint32_t takeovers_seen_ = 0;
};

}  // namespace armature::ride::internal
