// SPDX-License-Identifier: Apache-2.0
// What tools do with a running application; each is executed by the component's own thread.
#include <algorithm>
#include <memory>
#include <utility>

#include "armature/base/near_name.hpp"
#include "armature/component/author.hpp"
#include "armature/exec/application.hpp"
#include "armature/exec/internal/directory.hpp"
#include "armature/exec/internal/tool_ticket.hpp"
#include "armature/exec/modes.hpp"
#include "armature/exec/task.hpp"

namespace armature::exec {
namespace {

using component::Component;
using component::Outcome;
using internal::quoted;

template <typename Items>
auto find_in(const Items& items, std::string_view name) -> typename Items::value_type {
  for (auto* item : items) {
    if (item->name() == name) return item;
  }
  return nullptr;
}

std::string with_suggestion(std::string text, std::string_view name,
                            const std::vector<std::string>& known) {
  const std::string hint = base::suggestion(name, known);
  return hint.empty() ? text : std::move(text) + " (" + hint + ")";
}

std::string no_such(const std::string& kind, std::string_view name, const Component& component,
                    const std::vector<std::string>& known) {
  return with_suggestion(quoted(component.name()) + " has no " + kind + " " + quoted(name), name,
                         known);
}

template <typename Items>
std::vector<std::string> names_of(const Items& items) {
  std::vector<std::string> names;
  for (const auto* item : items) names.emplace_back(item->name());
  return names;
}

std::string not_answered(const Component& component) {
  return "the thread of " + quoted(component.name()) + " did not answer in time";
}

}  // namespace

Component* Application::find(std::string_view name) const {
  const auto found = index_of_.find(name);
  return found == index_of_.end() ? nullptr : blueprint_.components[found->second].component.get();
}

std::string Application::unknown_component(std::string_view name) const {
  std::vector<std::string> names;
  for (const ComponentEntry& entry : blueprint_.components) {
    names.push_back(entry.component->name());
  }
  return with_suggestion("unknown component " + quoted(name), name, names);
}

bool Application::run_in_thread_of(Component& component, std::function<void()> work) {
  component::ExecutionContext& context = component.context();
  const auto as_its_own = [&component, &context, work = std::move(work)] {
    component.run(context, work);
  };
  if (is_stuck(component)) return false;
  if (context.live) {
    // It may die of this work.
    return Task::run_in(context, as_its_own, options_.hook_limit, [this, &context] {
      return mourns_.load(std::memory_order_acquire) && dead_workplace_ == &context;
    });
  }
  context.cycle_time = now();
  as_its_own();
  return true;
}

Outcome Application::change(std::string_view name, std::function<Outcome(Component&)> transition) {
  Component* const component = find(name);
  if (component == nullptr) return component::refused(unknown_component(name));
  const auto outcome = std::make_shared<Outcome>(component::accepted());
  if (!run_in_thread_of(*component, [outcome, component, transition = std::move(transition)] {
        *outcome = transition(*component);
      })) {
    return component::refused(not_answered(*component));
  }
  return *outcome;
}

Outcome Application::start_component(std::string_view name) {
  return change(name, [modes = modes()](Component& component) {
    Outcome outcome = modes == nullptr ? component::accepted() : modes->admit(component);
    const bool fresh = component.state() == component::State::kPreOperational;
    if (outcome && fresh) outcome = component.configure();
    if (outcome && component.state() == component::State::kStopped) outcome = component.activate();
    return outcome ? component.start() : outcome;
  });
}

Outcome Application::stop_component(std::string_view name) {
  Component* const holder = find(name);
  if (holder != nullptr && !holds_nothing(name)) return begin_way_to_stop(*holder);
  if (const auto kept = holder != nullptr ? held_by_help_of(*holder) : std::nullopt) {
    return component::refused(quoted(name) + " was not stopped, since " + quoted(kept->component) +
                              " needs it and holds " + kept->what + "; or stop " +
                              quoted(kept->component) + " first");
  }
  return change(name, [](Component& component) {
    component.stop();
    return component::accepted();
  });
}

Outcome Application::recover_component(std::string_view name) {
  return change(name, [](Component& component) { return component.recover(); });
}

Outcome Application::reset_component(std::string_view name) {
  return change(name, [](Component& component) { return component.reset(); });
}

Outcome Application::clean_up_component(std::string_view name) {
  return change(name, [](Component& component) {
    if (component.state() != component::State::kStopped) {
      return component::refused("cannot be cleaned up: stop it first");
    }
    component.cleanup();
    return component::accepted();
  });
}

base::Result<void> Application::set_property(std::string_view name, std::string_view property_name,
                                             const types::Value& value, Caller caller) {
  Component* const component = find(name);
  if (component == nullptr) return base::Error{unknown_component(name)};
  const auto& properties = component->interface().properties;
  component::PropertyBase* const property = find_in(properties, property_name);
  if (property == nullptr) {
    return base::Error{no_such("property", property_name, *component, names_of(properties))};
  }
  if (property->is_by_operator()) {
    if (const auto may = granted(*component, property_name, caller); !may) return may;
  }
  const auto result = std::make_shared<base::Result<void>>();
  if (!run_in_thread_of(*component,
                        [result, property, value] { *result = property->set(value); })) {
    return base::Error{not_answered(*component)};
  }
  return *result;
}

base::Result<types::Value> Application::value_of(std::string_view name, std::string_view item) {
  Component* const component = find(name);
  if (component == nullptr) return base::Error{unknown_component(name)};
  const component::Interface& interface = component->interface();
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

base::Result<types::Value> Application::value_of(Component& component, const types::Type& type,
                                                 std::function<const void*()> data) {
  const auto value = std::make_shared<types::Value>(type);
  const auto copy = [value, data = std::move(data)] {
    value->type().assign(value->data(), data());
  };
  if (!run_in_thread_of(component, copy)) return base::Error{not_answered(component)};
  return *value;
}

base::Result<void> Application::granted(const Component& component, std::string_view act,
                                        Caller caller) const {
  if (caller == Caller::kOperator) return {};
  const auto grants_it = [&](const Grant& grant) {
    return grant.caller == caller && grant.component == component.name() && grant.operation == act;
  };
  if (std::any_of(options_.grants.begin(), options_.grants.end(), grants_it)) return {};
  const std::string whole = component.name() + "." + std::string(act);
  const bool script = caller == Caller::kScript;
  return base::Error{quoted(whole) +
                     " is an act of the operator: " + (script ? "a script" : "another process") +
                     " may use it only if the deployment grants it (grants: {" +
                     (script ? "script" : "remote") + ": [" + whole + "]})"};
}

base::Result<component::OperationBase*> Application::operation_for(std::string_view name,
                                                                   std::string_view operation_name,
                                                                   Caller caller) const {
  Component* const component = find(name);
  if (component == nullptr) return base::Error{unknown_component(name)};
  const auto& operations = component->interface().operations;
  component::OperationBase* const operation = find_in(operations, operation_name);
  if (operation == nullptr) {
    return base::Error{no_such("operation", operation_name, *component, names_of(operations))};
  }
  if (operation->is_by_operator()) {
    if (const auto may = granted(*component, operation_name, caller); !may) {
      return base::Error{may.error()};
    }
  }
  return operation;
}

base::Result<std::optional<types::Value>> Application::call(std::string_view name,
                                                            std::string_view operation_name,
                                                            std::vector<types::Value> arguments,
                                                            Caller caller) {
  const auto found = operation_for(name, operation_name, caller);
  if (!found) return base::Error{found.error()};
  component::OperationBase* const operation = found.value();
  using Answer = base::Result<std::optional<types::Value>>;
  const auto answer = std::make_shared<Answer>(std::optional<types::Value>());
  if (!run_in_thread_of(operation->owner(), [answer, operation, arguments = std::move(arguments)] {
        component::note(operation->owner(), component::BlackBox::Note::Kind::kCall,
                        operation->name(), {});
        *answer = operation->invoke(arguments);
      })) {
    return base::Error{not_answered(operation->owner())};
  }
  return *answer;
}

internal::ToolTicket& Application::claim_ticket(component::CommandBase& command) {
  auto free = std::find_if(tickets_.begin(), tickets_.end(),
                           [](const auto& ticket) { return ticket->try_claim(); });
  if (free == tickets_.end()) {
    free = tickets_.emplace(tickets_.end(), new internal::ToolTicket);
    static_cast<void>((*free)->try_claim());  // it is new: nobody else has it
  }
  (*free)->belong_to(command);
  return **free;
}

base::Result<component::CommandHandle> Application::begin(std::string_view name,
                                                          std::string_view command_name,
                                                          std::vector<types::Value> arguments,
                                                          Caller caller) {
  const auto found = operation_for(name, command_name, caller);
  if (!found) return base::Error{found.error()};
  if (!found.value()->is_command()) {
    return base::Error{quoted(std::string(name) + "." + std::string(command_name)) +
                       " is an operation, not a command: call it"};
  }
  auto* const command = static_cast<component::CommandBase*>(found.value());
  internal::ToolTicket* const ticket = &claim_ticket(*command);
  component::CommandHandle handle(*ticket);
  const auto begun = std::make_shared<base::Result<void>>();
  if (!run_in_thread_of(command->owner(),
                        [begun, command, ticket, arguments = std::move(arguments)] {
                          *begun = command->begin_with(ticket, arguments);
                        })) {
    return base::Error{not_answered(command->owner())};
  }
  if (!*begun) return base::Error{begun->error()};
  return handle;
}

std::vector<ThreadStatistics> Application::thread_statistics() const {
  std::vector<ThreadStatistics> all;
  for (Index t = 0; t < engines_.size(); ++t) {
    Engine& engine = *engines_[t];
    all.push_back({plan_.threads[t].name, engine.cycles_run(), engine.cycles_skipped(),
                   engine.log().dropped(), engine.latency_ns().summary(),
                   engine.cycle_ticks().summary()});
  }
  return all;
}

}  // namespace armature::exec
