// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "armature/component/internal/arguments.hpp"

namespace armature::component {

class CommandTicket;

namespace internal {

/// Commands that were accepted and have not begun, in their order, with their arguments. All memory
/// is there from the beginning on, except for larger vectors than `shape` was given.
class WaitingCommands {
 public:
  WaitingCommands(const Signature& signature, std::size_t capacity);

  /// Gives all places the shape of these arguments, so that `add` of such never allocates.
  void shape(const void* const* arguments);

  bool empty() const { return count_ == 0; }
  bool full() const { return count_ == capacity(); }
  std::size_t size() const { return count_; }
  std::size_t capacity() const { return places_.size() - 1; }

  /// One that waits, behind all others.
  /// @param ticket  nullptr: nobody asks
  /// @rt nonblocking, no allocation for arguments of the shape; not if `full`
  void add(CommandTicket* ticket, const void* const* arguments);

  struct Command {
    CommandTicket* ticket = nullptr;
    const void* const* arguments = nullptr;  ///< there until another one is taken
  };
  /// The first and the last of those that wait; not if `empty`.
  /// @rt nonblocking, no allocation
  Command take_first();
  Command take_last();
  /// Where `ticket` waits; size() if it does not.
  std::size_t find(const CommandTicket& ticket) const;

 private:
  struct Place {
    CommandTicket* ticket = nullptr;
    Arguments arguments;
  };
  Place& place(std::size_t index) { return places_[(first_ + index) % places_.size()]; }
  const Place& place(std::size_t index) const { return places_[(first_ + index) % places_.size()]; }

  std::vector<Place> places_;  ///< one more than may wait: whose arguments are in use
  std::size_t first_ = 0;
  std::size_t count_ = 0;
};

}  // namespace internal
}  // namespace armature::component
