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
  using Parameter = exec::CommandParameter;
  struct Wire {
    const Connection& connection;
    const component::EventBase& event;
    const component::CommandBase& command;
    std::vector<Parameter> parameters;
  };

  /// What is given for a parameter, as messages name it, and what to do if it does not fit.
  struct Offer {
    std::string what;
    const types::Type& type;
    std::string unit;
    base::Location where;
    const char* hint;
  };

  const component::Component* component_of(const std::string& name) const;
  const component::EventBase* event_of(const Endpoint& end) const;
  const component::CommandBase* command_of(const Connection& connection);
  void refuse_target(const Connection& connection, const component::Component& target);
  bool check_policy(const Connection& connection);
  bool check_names(const Wire& wire);
  /// False if a mistake was told.
  bool try_add(const Connection& connection);
  static bool are_named(const Wire& wire);
  bool check_max_age(const Wire& wire);
  std::optional<Parameter> parameter(const Wire& wire, std::size_t index);
  std::optional<Parameter> given(const Wire& wire, std::size_t index, const Property& written);
  std::optional<Parameter> from_member(const Wire& wire, std::size_t index, std::size_t member,
                                       const base::Location& where);
  std::optional<Parameter> from_port(const Wire& wire, std::size_t index, const Value& written);
  bool fits(const Wire& wire, std::size_t index, const Offer& offer);
  bool make(Wire&& wire);

  exec::Blueprint& blueprint_;
  Components& components_;
  const bool keeps_running_;
  base::Diagnostics& diagnostics_;
};

}  // namespace armature::deploy::internal
