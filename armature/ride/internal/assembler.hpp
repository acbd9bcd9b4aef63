// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <optional>
#include <span>

#include "armature/ride/body.hpp"
#include "armature/ride/wire.hpp"

namespace armature::ride::internal {

/// A whole message; its body lies in the assembler until more is received.
struct Message {
  Header header;
  std::span<const std::byte> body;
  Body* whole = nullptr;  ///< what it lies in, if it came in several: for who keeps it to move
};

/// Whether a body that goes on is worth its memory.
class BodyGate {
 public:
  virtual ~BodyGate() = default;
  /// @param first  its first message
  /// @return false: what comes of it is dropped, and nothing more is told of it
  virtual bool admits(const Message& first) = 0;
};

enum class Found {
  kMessage,
  kNothing,   ///< more has to be received first
  kTooLarge,  ///< a message that was too large has ended; `body` is how it began
  kNoMemory,  ///< the same of one that there was no memory for
  kBadMagic,  ///< these three are the end: nobody knows where the next message begins
  kBadLength,
  kTooMany,  ///< more messages go on at the same time than are kept
};

/// Makes messages of the bytes of a connection. Its memory is bounded: what was received and not
/// looked at, and `most_body` for all bodies that go on.
/// @thread one at a time
class Assembler {
 public:
  /// Of what was received and not looked at.
  static constexpr std::size_t kRoom = 128 * 1024;

  /// @param share  of which bodies that go on take their memory; none: without bound
  /// @param gate   asked before it takes any; none: takes all
  explicit Assembler(std::size_t most_body, MemoryShare* share = nullptr, BodyGate* gate = nullptr)
      : most_body_(most_body), share_(share), gate_(gate) {}

  /// Where to receive to: what is missing of the message that has begun, and at least 16 KiB, but
  /// no more, so that what one connection floods takes no long time to look at. Ends the life of
  /// the messages found.
  std::span<std::byte> room();
  void received(std::size_t size) { end_ += size; }
  /// The next message; call until it finds nothing.
  Found next(Message& message);
  /// The number of the oldest message that has begun and not ended; none if there is none.
  std::optional<std::uint64_t> incomplete() const {
    if (!parts_.empty()) return parts_.front().number;
    return begin_ != end_ ? std::optional(taken_) : std::nullopt;
  }
  void reset();
  /// Bytes of bodies that go on.
  std::size_t kept() const { return kept_; }

 private:
  static constexpr std::size_t kLeastRoom = 16 * 1024;
  static constexpr std::size_t kMostParts = 16;
  static constexpr std::size_t kBeginning = 8;  ///< operation and call

  /// A body that goes on in later messages.
  struct Parts {
    Header header;
    std::uint64_t number;  ///< of its first message
    Body body;
    Found end = Found::kMessage;  ///< kTooLarge, kNoMemory, kNothing: only its beginning is kept
  };

  Found join(Message& message);
  std::size_t missing() const;
  std::list<Parts>::iterator find(const Header& header);
  void add(Parts& parts, std::span<const std::byte> body);
  bool keep(Parts& parts, std::span<const std::byte> body);
  void keep_beginning(Parts& parts, Found end);

  const std::size_t most_body_;
  MemoryShare* const share_;
  BodyGate* const gate_;
  std::unique_ptr<std::byte[]> bytes_;
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  std::list<Parts> parts_;
  std::list<Parts> whole_;  ///< the one that was found last, as long as it is looked at
  std::size_t kept_ = 0;
  std::uint64_t taken_ = 0;  ///< messages that have ended
};

}  // namespace armature::ride::internal
