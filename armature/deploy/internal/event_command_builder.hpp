// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

#include "armature/base/diagnostic.hpp"
#include "armature/component/events/event.hpp"
#include "armature/component/operations/command.hpp"
#include "armature/document/document.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/exec/blueprint.hpp"
#include "armature/exec/event_command.hpp"

namespace armature::deploy::internal {

using namespace document;

/// How messages name an end.
inline std::string path(const Endpoint& end) { return in_quotes(to_text(end)); }

/// Makes the components that give a command when an event is raised.
class EventCommandBuilder {
 public:
  using Components = std::unordered_map<std::string_view, const component::Component*>;

  /// @param components  all of the blueprint; what is made is added
  EventCommandBuilder(exec::Blueprint& blueprint, Components& components,
                      base::Diagnostics& diagnostics)
      : blueprint_(blueprint), components_(components), diagnostics_(diagnostics) {}

  /// It begins at an event that is there already.
  bool is_one(const Connection& connection) const { return event_of(connection.from) != nullptr; }
  /// It is one.
  void add(const Connection& connection);

 private:
  using Parameter = exec::CommandParameter;
  struct Wire {
    const Connection& connection;
    const component::EventBase& event;
    const component::CommandBase& command;
    std::vector<Parameter> parameters;
  };

  const component::Component* component_of(const std::string& name) const;
  const component::EventBase* event_of(const Endpoint& end) const;
  const component::CommandBase* command_of(const Connection& connection);
  void refuse_target(const Connection& connection, const component::Component& target);
  bool check_policy(const Connection& connection);
  bool check_names(const Wire& wire);
  std::optional<Parameter> parameter(const Wire& wire, std::size_t index);
  std::optional<Parameter> given(const Wire& wire, std::size_t index, const Property& written);
  std::optional<Parameter> from_member(const Wire& wire, std::size_t index, std::size_t member,
                                       const base::Location& where);
  std::optional<Parameter> from_port(const Wire& wire, std::size_t index, const Value& written);
  void make(Wire&& wire);

  exec::Blueprint& blueprint_;
  Components& components_;
  base::Diagnostics& diagnostics_;
};

}  // namespace armature::deploy::internal
