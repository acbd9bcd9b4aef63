// SPDX-License-Identifier: Apache-2.0
// What tools do with a running application; each is executed by the component's own thread.
#include <memory>
#include <utility>

#include "armature/base/near_name.hpp"
#include "armature/component/author.hpp"
#include "armature/exec/application.hpp"

namespace armature::exec {
namespace {

using component::Component;
using component::Outcome;

std::string quoted(std::string_view name) { return "'" + std::string(name) + "'"; }

template <typename Items>
auto find_in(const Items& items, std::string_view name) -> typename Items::value_type {
  for (auto* item : items) {
    if (item->name() == name) return item;
  }
  return nullptr;
}

base::Error unknown(std::string_view name, const char* what) {
  return base::Error{"there is no " + std::string(what) + " " + quoted(name)};
}

base::Error not_answered(const Component& component) {
  return base::Error{"the thread of " + quoted(component.name()) + " did not answer in time"};
}

}  // namespace

Component* Application::find(std::string_view name) const {
  for (const ComponentEntry& entry : blueprint_.components) {
    if (entry.component->name() == name) return entry.component.get();
  }
  return nullptr;
}

bool Application::run_in_thread_of(const Component& component, std::function<void()> work) {
  component::ExecutionContext& context = component.context();
  if (context.live) return Task::run_in(context, std::move(work), options_.hook_limit);
  context.cycle_time = now();
  work();
  return true;
}

Outcome Application::change(std::string_view name, Outcome (*transition)(Component&)) {
  Component* const component = find(name);
  if (component == nullptr) return component::refused("there is no such component");
  const auto outcome = std::make_shared<Outcome>(component::accepted());
  if (!run_in_thread_of(*component,
                        [outcome, component, transition] { *outcome = transition(*component); })) {
    return component::refused("its thread did not answer in time");
  }
  return *outcome;
}

Outcome Application::start_component(std::string_view name) {
  return change(name, [](Component& component) {
    const bool fresh = component.state() == component::State::kPreOperational;
    Outcome outcome = fresh ? component.configure() : component::accepted();
    if (outcome && component.state() == component::State::kStopped) outcome = component.activate();
    return outcome ? component.start() : outcome;
  });
}

Outcome Application::stop_component(std::string_view name) {
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

base::Result<void> Application::set_property(std::string_view name, std::string_view property_name,
                                             const types::Value& value) {
  Component* const component = find(name);
  if (component == nullptr) return unknown(name, "component");
  component::PropertyBase* const property =
      find_in(component->interface().properties, property_name);
  if (property == nullptr) return unknown(property_name, "property");
  const auto result = std::make_shared<base::Result<void>>();
  if (!run_in_thread_of(*component,
                        [result, property, value] { *result = property->set(value); })) {
    return not_answered(*component);
  }
  return *result;
}

base::Result<types::Value> Application::value_of(std::string_view name, std::string_view item) {
  Component* const component = find(name);
  if (component == nullptr) return unknown(name, "component");
  const component::Interface& interface = component->interface();
  const types::Type* type = nullptr;
  std::function<const void*()> data;
  if (auto* property = find_in(interface.properties, item)) {
    type = &property->type();
    data = [property] { return property->data(); };
  } else if (auto* input = find_in(interface.inputs, item)) {
    type = &input->type();
    data = [input] { return input->current(); };
  } else if (auto* output = find_in(interface.outputs, item)) {
    type = &output->type();
    data = [output] { return output->current(); };
  } else {
    return unknown(item, "property or port");
  }
  const auto value = std::make_shared<types::Value>(*type);
  if (!run_in_thread_of(*component,
                        [value, data] { *value = types::Value(value->type(), data()); })) {
    return not_answered(*component);
  }
  return *value;
}

base::Result<std::optional<types::Value>> Application::call(std::string_view name,
                                                            std::string_view operation_name,
                                                            std::vector<types::Value> arguments) {
  Component* const component = find(name);
  if (component == nullptr) return unknown(name, "component");
  component::OperationBase* const operation =
      find_in(component->interface().operations, operation_name);
  if (operation == nullptr) return unknown(operation_name, "operation");
  using Answer = base::Result<std::optional<types::Value>>;
  const auto answer = std::make_shared<Answer>(std::optional<types::Value>());
  if (!run_in_thread_of(*component, [answer, operation, arguments = std::move(arguments)] {
        *answer = operation->invoke(arguments);
      })) {
    return not_answered(*component);
  }
  return *answer;
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
