// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "armature/component/component.hpp"

namespace armature::component {

class CommandBase;
class CommandsUnderWay;
class InputPortBase;
class OperationBase;
enum class CallStatus : std::uint8_t;

/// A component that stands for another one, which lives elsewhere, such as in another process. Its
/// interface consists of twins of the other's members (`twin` of ports, operations and events);
/// what comes to them it passes on. Only its own thread, which is not real-time, ever waits.
class StandIn : public Component {
 public:
  using Component::Component;

  /// Something new came to a twin of an input.
  /// @param value  of the input's type
  /// @thread the component's own
  virtual void pass_on(InputPortBase& input, const void* value) = 0;

  /// Calls the twin's original and waits for the answer.
  /// @param arguments  where they are, as the operation's signature has them
  /// @param result     where it goes; nullptr if there is none
  /// @thread the component's own
  virtual CallStatus call(OperationBase& operation, const void* const* arguments, void* result) = 0;

  /// Of a command that is done elsewhere before its answer is here, several may be under way: each
  /// is begun as it comes, and what this returns is told how it ended.
  /// @return nullptr: one at a time, whose end the twin is told
  /// @thread the component's own
  virtual CommandsUnderWay* several(const CommandBase& /*command*/) { return nullptr; }

  /// Begins the twin's original; the component says later how it ended.
  /// @thread the component's own
  virtual Outcome begin(CommandBase& command, const void* const* arguments) = 0;
  /// The command is not wanted any more.
  /// @thread the component's own
  virtual void cancel(CommandBase& command) = 0;
};

}  // namespace armature::component
