// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/component/events/event.hpp"
#include "armature/component/operations/command.hpp"
#include "armature/deploy/internal/parameter_builder.hpp"
#include "armature/exec/blueprint.hpp"
#include "armature/exec/event_command.hpp"

namespace armature::deploy::internal {

/// Makes the components that give a command when an event is raised.
class EventCommandBuilder {
 public:
  /// @param components     all of the blueprint; what is made is added
  /// @param keeps_running  also without who writes a parameter's port
  EventCommandBuilder(exec::Blueprint& blueprint, Components& components, bool keeps_running,
                      base::Diagnostics& diagnostics)
      : blueprint_(blueprint),
        components_(components),
        keeps_running_(keeps_running),
        diagnostics_(diagnostics) {}

  /// It begins at an event that is there already.
  bool is_one(const Connection& connection) const { return event_of(connection.from) != nullptr; }
  /// It is one.
  void add(const Connection& connection);

 private:
  using Parameter = component::CallParameter;
  struct Wire {
    const Connection& connection;
    const component::EventBase& event;
    const component::CommandBase& command;
    std::vector<Parameter> parameters;
  };

  const component::EventBase* event_of(const Endpoint& end) const;
  const component::CommandBase* command_of(const Connection& connection);
  void refuse_target(const Connection& connection, const component::Component& target);
  bool check_policy(const Connection& connection);
  /// False if a mistake was told.
  bool try_add(const Connection& connection);
  bool check_max_age(const Wire& wire);
  bool make(Wire&& wire);

  exec::Blueprint& blueprint_;
  Components& components_;
  const bool keeps_running_;
  base::Diagnostics& diagnostics_;
};

}  // namespace armature::deploy::internal
