// SPDX-License-Identifier: Apache-2.0
#include "armature/testing/harness.hpp"

#include <stdexcept>

#include "armature/base/near_name.hpp"
#include "armature/base/quoted.hpp"
#include "armature/component/host.hpp"

namespace armature::testing {

using base::quoted;

namespace {

template <typename Items>
auto& find_in(const Items& items, const component::Component& component, const char* kind,
              std::string_view name) {
  std::vector<std::string> names;
  for (auto* item : items) {
    if (item->name() == name) return *item;
    names.emplace_back(item->name());
  }
  const std::string hint = base::suggestion(name, names).text;
  throw std::invalid_argument(quoted(component.name()) + " has no " + kind + " " + quoted(name) +
                              (hint.empty() ? "" : "; " + hint));
}

}  // namespace

Harness::Harness(std::unique_ptr<component::Component> component, base::Duration period)
    : component_(std::move(component)),
      engine_("test", exec::Activity::triggered(), {component_.get()}, {}),
      period_(period) {
  engine_.context().simulated = true;
  engine_.begin(now_);
}

Harness::~Harness() {
  component::Host::stop(*component_);
  component::Host::cleanup(*component_);
  for (auto* event : component::interface_of(*component_).events) event->unsubscribe_all();
  for (auto* caller : component::interface_of(*component_).callers) caller->disconnect();
}

component::Outcome Harness::start() {
  using component::State;
  engine_.context().cycle_time = now_;  // as an application does before it starts anything
  if (state() == State::kPreOperational) {
    if (component::Outcome configured = component::Host::configure(*component_); !configured)
      return configured;
    for (auto* output : component::interface_of(*component_).outputs) output->prepare();
  }
  if (component::Outcome activated = component::Host::activate(*component_); !activated)
    return activated;
  component::Outcome started = component::Host::start(*component_);
  engine_.begin(now_);
  return started;
}

void Harness::run_cycles(int count) {
  for (int i = 0; i < count; ++i) {
    now_ += period_;
    in_thread([this] { component::Host::update(*component_); });
  }
}

void Harness::advance(base::Duration time) {
  now_ += time;
  engine_.step(now_);
}

void Harness::set(std::string_view name, std::string_view text) {
  component::PropertyBase& property = find_property(name);
  types::Value value(property.type());
  base::Result<void> result = types::from_text(property.type(), text, value.data());
  if (result) result = property.set(value);
  if (!result) {
    throw std::invalid_argument(quoted(component_->name()) + ": property " + quoted(name) + ": " +
                                result.error());
  }
}

const std::vector<std::string>& Harness::log() {
  while (const rt::LogRecord* record = engine_.log().pop()) {
    log_.push_back(std::string(rt::name_of(record->level)) + ": " + record->message());
  }
  return log_;
}

component::PropertyBase& Harness::find_property(std::string_view name) const {
  return find_in(component::interface_of(*component_).properties, *component_, "property", name);
}

component::InputPortBase& Harness::find_input(std::string_view name) const {
  return find_in(component::interface_of(*component_).inputs, *component_, "input", name);
}

component::OutputPortBase& Harness::find_output(std::string_view name) const {
  return find_in(component::interface_of(*component_).outputs, *component_, "output", name);
}

component::OperationBase& Harness::find_operation(std::string_view name) const {
  return find_in(component::interface_of(*component_).operations, *component_, "operation", name);
}

component::OperationCallerBase& Harness::find_caller(std::string_view name) const {
  return find_in(component::interface_of(*component_).callers, *component_, "use of an operation",
                 name);
}

component::EventBase& Harness::find_event(std::string_view name) const {
  return find_in(component::interface_of(*component_).events, *component_, "event", name);
}

component::EventHandlerBase& Harness::find_handler(std::string_view name) const {
  return find_in(component::interface_of(*component_).handlers, *component_, "handler of an event",
                 name);
}

void Harness::check_type(std::string_view item, const types::Type& is,
                         const types::Type& given) const {
  if (types::same_type(is, given)) return;
  throw std::invalid_argument(quoted(component_->name()) + ": " + quoted(item) + " is of type " +
                              is.name + ", not " + given.name);
}

void Harness::check_result(std::string_view operation, const types::Type* is,
                           const types::Type& wanted) const {
  if (is != nullptr && types::same_type(*is, wanted)) return;
  throw std::invalid_argument(quoted(component_->name()) + ": " + quoted(operation) + " returns " +
                              (is == nullptr ? std::string("nothing") : is->name) + ", not " +
                              wanted.name);
}

void Harness::check_size(std::string_view input, bool fits) const {
  if (fits) return;
  throw std::invalid_argument(quoted(component_->name()) + ": " + quoted(input) +
                              " was configured for vectors of another size");
}

void Harness::check_signature(std::string_view item, const component::Signature& is,
                              const component::Signature& given) const {
  if (is.same_as(given)) return;
  throw std::invalid_argument(quoted(component_->name()) + ": " + quoted(item) + " is " +
                              is.text() + ", not " + given.text());
}

void Harness::check_command(std::string_view item,
                            const component::OperationBase& operation) const {
  if (operation.is_command()) return;
  throw std::invalid_argument(quoted(component_->name()) + ": " + quoted(item) +
                              " is not a command");
}

}  // namespace armature::testing
