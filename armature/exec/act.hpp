// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/types/enum.hpp"
#include "armature/types/type.hpp"

namespace armature::exec {

enum class Caller : std::uint8_t;

/// Something that is done to a running application from outside: by the operator, a script or
/// another process. In simulated time the acts of a run are all in which it differs from another
/// run of the same deployment.
struct Act {
  /// What is done.
  enum class Kind : std::uint8_t {
    kCall,        ///< of an operation
    kBegin,       ///< of a command
    kCancel,      ///< of the command that the act with the same `command` began
    kSet,         ///< of a property
    kWrite,       ///< of an input that is open to the operator or to other processes
    kStart,       ///< of a component, like the following
    kStop,        ///< which may first do its commands of `before_stop`
    kCancelStop,  ///< of a component that is on its way to the stop
    kRecover,
    kReset,
    kCleanUp,
    kMode,        ///< the mode's name is the item
    kBeforeStop,  ///< the end of the run begins; the item is how it has ended (RunEnd)
    kMistake,     ///< likewise, after a mistake of who commanded it
    kEnd,         ///< everything stops
    // What became of an act that was told before, by its `number`:
    kRefused,  ///< since `item`
    kDone,     ///< in real time: at `time`, by the thread of its component
  };
  Kind kind = Kind::kCall;
  std::string component{};
  std::string item{};
  std::vector<types::Value> values{};  ///< arguments, or the one that is set or written
  Caller caller{};
  std::uint32_t command = 0;  ///< counts the commands that were begun, from 1
  base::Time time{};          ///< on the application's clock
  /// Of simulated time: so many turns threads had taken by then. Threads take turns at an instant
  /// until nothing is left to do; what is done then belongs between two of them.
  std::uint64_t turn = 0;
  std::uint64_t number = 0;  ///< kRefused, kDone: the act's, in the order of telling, from 1
  /// By a tool that was attended to (`ApplicationOptions::attend`): what it sends to other threads
  /// arrives with the next instant.
  bool attended = false;
};
ARMATURE_ENUM(Act::Kind, kCall, kBegin, kCancel, kSet, kWrite, kStart, kStop, kCancelStop, kRecover,
              kReset, kCleanUp, kMode, kBeforeStop, kMistake, kEnd, kRefused, kDone);

}  // namespace armature::exec
