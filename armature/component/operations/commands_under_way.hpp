// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "armature/component/operations/command.hpp"

namespace armature::component {

/// Runs of one command that are under way at the same time, each of which ends on its own: of a
/// command that lives elsewhere, and is done there before its answer is here.
/// @rt nonblocking, no allocation, O(kMost)
/// @thread that of the command's component
class CommandsUnderWay {
 public:
  /// As many as a connection from an event to a command gives at most (exec::EventCommand).
  static constexpr std::size_t kMost = 16;

  /// @param command  the twin that is given; outlives this
  explicit CommandsUnderWay(const CommandBase& command) : command_(command) {}
  ~CommandsUnderWay();
  CommandsUnderWay(const CommandsUnderWay&) = delete;
  CommandsUnderWay& operator=(const CommandsUnderWay&) = delete;

  std::size_t size() const { return count_; }
  bool full() const { return count_ == kMost; }

  /// Another one begins, which `newest` names from now on; not if `full`.
  /// @param ticket  is told how it ends; nullptr: nobody asks
  void add(CommandTicket* ticket);
  /// Names the one that has begun last.
  std::uint64_t newest() const { return newest_; }
  bool has(std::uint64_t run) const { return place_of(run) < count_; }

  /// Nothing happens if it has ended.
  void end(std::uint64_t run, CommandStage stage, std::string_view reason);
  void end(const CommandTicket& ticket, CommandStage stage, std::string_view reason);
  /// In the order in which they began.
  void end_all(CommandStage stage, std::string_view reason);

 private:
  struct Run {
    std::uint64_t number = 0;
    CommandTicket* ticket = nullptr;
  };
  /// `count_`: it has ended.
  std::size_t place_of(std::uint64_t run) const;
  /// Of the one at `place`: those behind it close up first, as its sender may begin another one.
  void end_at(std::size_t place, CommandStage stage, std::string_view reason);

  const CommandBase& command_;
  std::array<Run, kMost> runs_{};
  std::size_t count_ = 0;
  std::uint64_t newest_ = 0;
};

}  // namespace armature::component
