// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/internal/application/tool_access.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "armature/base/near_name.hpp"
#include "armature/base/quoted.hpp"
#include "armature/component/author.hpp"
#include "armature/component/interface.hpp"

namespace armature::exec::internal {
namespace {

using base::quoted;
using component::Component;

template <typename Items>
auto find_in(const Items& items, std::string_view name) -> typename Items::value_type {
  for (auto* item : items) {
    if (item->name() == name) return item;
  }
  return nullptr;
}

std::string no_such(const std::string& kind, std::string_view name, const Component& component,
                    const std::vector<std::string>& known) {
  return quoted(component.name()) + " has no " + kind + " " + quoted(name) +
         base::suggestion_in_brackets(name, known);
}

template <typename Items>
std::vector<std::string> names_of(const Items& items) {
  std::vector<std::string> names;
  for (const auto* item : items) names.emplace_back(item->name());
  return names;
}

}  // namespace

base::Result<void> ToolAccess::set_property(std::string_view name, std::string_view property_name,
                                            const types::Value& value, Caller caller) const {
  Component* const component = roster_.find(name);
  if (component == nullptr) return base::Error{roster_.unknown(name)};
  const auto& properties = component::interface_of(*component).properties;
  component::PropertyBase* const property = find_in(properties, property_name);
  if (property == nullptr) {
    return base::Error{no_such("property", property_name, *component, names_of(properties))};
  }
  if (property->is_by_operator()) {
    if (const auto may = granted(*component, property_name, caller); !may) return may;
  }
  const auto result = std::make_shared<base::Result<void>>();
  if (!executor_.run_in_thread_of(*component,
                                  [result, property, value] { *result = property->set(value); })) {
    return base::Error{not_answered(*component)};
  }
  return *result;
}

base::Result<types::Value> ToolAccess::value_of(std::string_view name,
                                                std::string_view item) const {
  Component* const component = roster_.find(name);
  if (component == nullptr) return base::Error{roster_.unknown(name)};
  const component::Interface& interface = component::interface_of(*component);
  if (auto* property = find_in(interface.properties, item)) {
    return value_of(*component, property->type(), [property] { return property->data(); });
  }
  const component::PortBase* port = find_in(interface.inputs, item);
  if (port == nullptr) port = find_in(interface.outputs, item);
  if (port != nullptr) {
    return value_of(*component, port->type(), [port] { return port->current(); });
  }
  std::vector<std::string> names;
  for (const auto* property : interface.properties) names.emplace_back(property->name());
  for (const auto* input : interface.inputs) names.push_back(input->name());
  for (const auto* output : interface.outputs) names.push_back(output->name());
  return base::Error{no_such("property or port", item, *component, names)};
}

base::Result<types::Value> ToolAccess::value_of(Component& component, const types::Type& type,
                                                std::function<const void*()> data) const {
  const auto value = std::make_shared<types::Value>(type);
  const auto copy = [value, data = std::move(data)] {
    value->type().assign(value->data(), data());
  };
  if (!executor_.run_in_thread_of(component, copy)) return base::Error{not_answered(component)};
  return *value;
}

base::Result<void> ToolAccess::granted(const Component& component, std::string_view act,
                                       Caller caller) const {
  if (caller == Caller::kOperator) return {};
  const auto grants_it = [&](const Grant& grant) {
    return grant.caller == caller && grant.component == component.name() && grant.operation == act;
  };
  if (std::any_of(grants_.begin(), grants_.end(), grants_it)) return {};
  const std::string whole = component.name() + "." + std::string(act);
  const bool script = caller == Caller::kScript;
  return base::Error{quoted(whole) +
                     " is an act of the operator: " + (script ? "a script" : "another process") +
                     " may use it only if the deployment grants it (grants: {" +
                     (script ? "script" : "remote") + ": [" + whole + "]})"};
}

base::Result<component::OperationBase*> ToolAccess::operation_for(std::string_view name,
                                                                  std::string_view operation_name,
                                                                  Caller caller) const {
  Component* const component = roster_.find(name);
  if (component == nullptr) return base::Error{roster_.unknown(name)};
  const auto& operations = component::interface_of(*component).operations;
  component::OperationBase* const operation = find_in(operations, operation_name);
  if (operation == nullptr) {
    return base::Error{no_such("operation", operation_name, *component, names_of(operations))};
  }
  if (!operation->is_offered()) return base::Error{operation->why_not_offered()};
  if (operation->is_by_operator()) {
    if (const auto may = granted(*component, operation_name, caller); !may) {
      return base::Error{may.error()};
    }
  }
  return operation;
}

base::Result<std::optional<types::Value>> ToolAccess::call(std::string_view name,
                                                           std::string_view operation_name,
                                                           std::vector<types::Value> arguments,
                                                           Caller caller) const {
  const auto found = operation_for(name, operation_name, caller);
  if (!found) return base::Error{found.error()};
  component::OperationBase* const operation = found.value();
  using Answer = base::Result<std::optional<types::Value>>;
  const auto answer = std::make_shared<Answer>(std::optional<types::Value>());
  if (!executor_.run_in_thread_of(
          operation->owner(), [answer, operation, arguments = std::move(arguments)] {
            component::note(operation->owner(), component::BlackBox::Note::Kind::kCall,
                            operation->name(), {});
            *answer = operation->invoke(arguments);
          })) {
    return base::Error{not_answered(operation->owner())};
  }
  return *answer;
}

base::Result<component::CommandHandle> ToolAccess::begin(std::string_view name,
                                                         std::string_view command_name,
                                                         std::vector<types::Value> arguments,
                                                         Caller caller,
                                                         std::uint32_t number) const {
  const auto found = operation_for(name, command_name, caller);
  if (!found) return base::Error{found.error()};
  if (!found.value()->is_command()) {
    return base::Error{quoted(std::string(name) + "." + std::string(command_name)) +
                       " is an operation, not a command: call it"};
  }
  auto* const command = static_cast<component::CommandBase*>(found.value());
  ToolTicket* const ticket = &tickets_.claim(*command, number);
  component::CommandHandle handle(*ticket);
  const auto begun = std::make_shared<base::Result<void>>();
  if (!executor_.run_in_thread_of(command->owner(),
                                  [begun, command, ticket, arguments = std::move(arguments)] {
                                    *begun = command->begin_with(ticket, arguments);
                                  })) {
    return base::Error{not_answered(command->owner())};
  }
  if (!*begun) return base::Error{begun->error()};
  return handle;
}

}  // namespace armature::exec::internal
