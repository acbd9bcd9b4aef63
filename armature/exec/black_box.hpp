// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/component/black_box.hpp"

namespace armature::exec {

/// The last seconds before a fault.
struct BlackBoxReport {
  /// What the samples of one port or event are.
  struct Channel {
    std::string name;    ///< such as `PID1.Out`; of an event how often it was raised
    types::Value shape;  ///< of the samples' type
    std::string unit;
    std::string doc;
  };
  /// What a port held, or how often an event was raised, after a cycle.
  struct Sample {
    std::size_t channel = 0;
    base::Time time{};             ///< of the cycle after which it was so
    std::vector<std::byte> value;  ///< as types::encode has it
  };
  /// Something rare that happened: a transition, a fault, a command.
  struct Happening {
    base::Time time{};
    std::string component;
    std::string kind;  ///< such as `fault`, `command begun`
    std::string item;  ///< the command, operation or property
    std::string text;
  };
  std::string component;  ///< the first that faulted, or that a reaction stopped
  std::string reason;
  base::Time time{};       ///< of the fault
  std::string incomplete;  ///< what is not here, and why; empty if all is
  std::vector<Channel> channels;
  std::vector<Sample> samples;        ///< in the order of time
  std::vector<Happening> happenings;  ///< likewise
};

/// How much the black box keeps, and who writes it.
struct BlackBoxOptions {
  /// Writes a report; called by the controlling thread soon after a fault, and says what became of
  /// it. Empty: nothing is kept.
  std::function<std::string(const BlackBoxReport&)> write;
  base::Duration history = std::chrono::seconds(2);  ///< zero: nothing is kept
  /// [bytes] of all threads. Where it is too small for the history, there is less of it, down to a
  /// quarter, and then its pictures lie further apart; there are always a few.
  std::size_t memory = 64u << 10;
};

}  // namespace armature::exec
