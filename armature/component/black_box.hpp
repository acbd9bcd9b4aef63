// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/component/outcome.hpp"
#include "armature/rt/try_lock.hpp"
#include "armature/types/type.hpp"

namespace armature::component {

class Component;
class EventBase;
class OutputPortBase;

/// What one thread's components wrote and did lately, in memory of a fixed size: pictures of all
/// their output ports and of how often their events were raised, and notes of what is rare. New
/// ones take the place of the oldest.
class BlackBox {
 public:
  /// Something rare that happened: a transition, a fault, a command.
  struct Note {
    /// What it was.
    enum class Kind : std::uint8_t {
      kState,  ///< the text is the new one's name
      kError,
      kFault,
      kReaction,
      kBegun,  ///< a command; the item is its name, here and below
      kRefused,
      kDone,
      kFailed,
      kCancelled,
      kProperty,  ///< a tool set it; the text is its value
      kCall,      ///< a tool called an operation
    };
    Kind kind = Kind::kState;
    base::Time time{};
    const Component* component = nullptr;
    std::string_view item;  ///< lives as long as the component
    Reason text;
  };
  /// Where the value of a port, or the count of an event, lies in a picture.
  struct Channel {
    const OutputPortBase* port;  ///< nullptr: of an event
    const EventBase* event;
    std::size_t offset;
    std::optional<types::Value> shape;  ///< of a port's type, if its vectors have sizes
  };
  /// A copy of everything that is kept.
  struct Content {
    std::vector<std::byte> pictures;  ///< the oldest first, each of `picture_size` bytes
    std::vector<base::Time> times;    ///< of the pictures: the cycles after which they were made
    std::vector<Note> notes;          ///< the oldest first
  };

  /// The component's events, and output ports of at most 16 KiB, which have and keep their shape.
  /// @thread configuration only
  void add(const Component& component);
  /// Makes room for so many pictures, which are made no more often than that.
  /// @thread configuration only
  void reserve(std::size_t pictures, std::size_t notes, base::Duration interval);

  const std::vector<Channel>& channels() const { return channels_; }
  std::size_t values() const { return spans_.size() + events_.size(); }
  /// [bytes]
  std::size_t picture_size() const { return ports_size_ + events_.size() * sizeof(std::uint64_t); }
  /// The value of a port, or the count of an event, in a picture.
  /// @thread any
  static types::Value value_in(const std::byte* picture, const Channel& channel);

  /// True if a picture is to be made after the cycle of that time.
  /// @rt nonblocking, no allocation
  /// @thread the components', as for the two below
  bool due(base::Time now) const noexcept { return now >= due_ || now == made_; }
  /// @rt nonblocking, no allocation, O(values)
  void make_picture(base::Time now) noexcept;
  /// After a fault or reaction a picture is made in any case.
  /// @rt nonblocking, no allocation
  void note(Note::Kind kind, const Component& component, std::string_view item,
            std::string_view text) noexcept;

  /// A copy of all there is; nothing if the thread is stuck while it adds to it.
  /// @thread one that may wait and allocate
  std::optional<Content> copy() const;
  /// What came while a copy was made, and is not here.
  std::uint64_t missed() const { return missed_.load(std::memory_order_relaxed); }

 private:
  struct Span {
    const std::byte* from;
    std::size_t size;
  };
  void count_missed() noexcept {
    missed_.store(missed_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  }

  std::vector<Span> spans_;  ///< of the values of ports, then come the counts
  std::vector<const EventBase*> events_;
  std::vector<Channel> channels_;
  std::size_t ports_size_ = 0;  ///< of their values in a picture
  base::Duration interval_{};
  base::Duration early_{};  ///< so much earlier than due is in time
  base::Time due_ = base::Time::max();
  base::Time made_ = base::Time::min();
  std::atomic<std::uint64_t> missed_{0};

  mutable rt::TryLock lock_;  // of all below
  std::vector<std::byte> pictures_;
  std::vector<base::Time> times_;
  std::vector<Note> notes_;
  std::uint64_t pictures_made_ = 0;
  std::uint64_t notes_taken_ = 0;
};

std::string_view name_of(BlackBox::Note::Kind kind);

/// Notes it in the black box of the component's thread, if it has one.
/// @rt nonblocking, no allocation
/// @thread the component's own
void note(const Component& component, BlackBox::Note::Kind kind, std::string_view item,
          std::string_view text) noexcept;

}  // namespace armature::component
