// SPDX-License-Identifier: Apache-2.0
#include "armature/inspect/application_view.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>

#include "armature/base/seconds.hpp"
#include "armature/base/unit.hpp"
#include "armature/component/author.hpp"
#include "armature/inspect/acts.hpp"
#include "armature/inspect/internal/begun_commands.hpp"
#include "armature/inspect/internal/snapshot.hpp"
#include "armature/inspect/internal/statuses.hpp"
#include "armature/inspect/items.hpp"
#include "armature/types/elements.hpp"

namespace armature::inspect {
namespace {

using component::Component;
using exec::Application;

/// What `result` has; what is wrong is the application's refusal.
template <typename T>
T answer_of(base::Result<T> result) {
  if (!result) throw Refusal(result.error());
  if constexpr (!std::is_void_v<T>) return std::move(result).value();
}

// --- reading -------------------------------------------------------------------------------------

std::vector<Component*> chosen(const Application& application, const View::Which& which) {
  std::vector<Component*> all;
  for (const exec::ComponentEntry& entry : application.blueprint().components) {
    if (which(entry.component->name())) all.push_back(entry.component.get());
  }
  return all;
}

/// Nothing if its thread does not answer.
std::shared_ptr<const internal::Snapshot> snapshot_of(Application& application,
                                                      Component& component) {
  const auto snapshot = std::make_shared<internal::Snapshot>(component);
  const auto take = [snapshot, now = application.now()] { snapshot->take(now); };
  return application.run_in_thread_of(component, take) ? snapshot : nullptr;
}

const char* kind_of(const Member& member) {
  if (member.input != nullptr) return "input";
  if (member.output != nullptr) return "output";
  return member.property->persistent() ? "property" : "attribute";
}

ItemValue no_value(const std::string& item, const std::string& error) {
  ItemValue value;
  value.item = item;
  value.error = error;
  return value;
}

/// @param reading  nullptr: nobody answered
ItemValue value_of(const Item& item, const Reading* reading) {
  ItemValue value = no_value(item.text, {});
  value.kind = kind_of(item.member);
  value.type = item.type->name;
  value.unit = item.unit;
  if (reading == nullptr) {
    value.error = "the thread of '" + item.member.component->name() + "' does not answer";
    return value;
  }
  value.written = reading->written;
  if (!reading->written) return value;
  value.age = reading->age;
  const void* const part = part_of(item, reading->whole);
  if (part == nullptr) {
    value.error = "'" + item.text + "' is not there: it is " + reading->whole.text();
  } else {
    value.value = types::to_text(*item.type, part);
  }
  return value;
}

// --- texts that become values --------------------------------------------------------------------

/// @param what  names the value in an error
types::Value value_from(const types::Type& type, const std::string& text, const std::string& what) {
  types::Value value(type);
  const auto read = types::from_text(type, text, value.data());
  if (!read) throw Refusal(what + ": " + read.error());
  return value;
}

/// A number with a unit in that of the property or port.
std::string in_unit_of(const Member& member, const std::string& text, const std::string& name) {
  const auto quantity = base::parse_quantity(text);
  if (!quantity || quantity.value().unit.empty() || !types::is_number(member.type())) return text;
  const auto number =
      base::convert(quantity.value().value, quantity.value().unit, std::string(member.unit()));
  if (!number) throw Refusal(name + ": " + number.error());
  return types::Value::of(number.value()).text();
}

Member operation_named(const Application& application, const std::string& component,
                       const std::string& operation) {
  const Member member = answer_of(find_member(application, component + ":" + operation));
  if (member.operation != nullptr) return member;
  throw Refusal("'" + component + "." + operation + "' is neither an operation nor a command");
}

std::vector<types::Value> arguments_of(const Member& operation,
                                       const std::vector<std::string>& given) {
  answer_of(check_count(operation, given.size()));
  const auto& wanted = operation.operation->signature().arguments;
  std::vector<types::Value> values;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    values.push_back(value_from(*wanted[i].type, given[i], argument_name(operation, i)));
  }
  return values;
}

// --- the life cycle ------------------------------------------------------------------------------

component::Outcome apply(Application& application, const std::string& component,
                         LifeCycleChange change) {
  switch (change) {
    case LifeCycleChange::kStart:
      return application.start_component(component);
    case LifeCycleChange::kStop:
      return application.stop_component(component);
    case LifeCycleChange::kReset:
      return application.reset_component(component);
    case LifeCycleChange::kRecover:
      return application.recover_component(component);
    case LifeCycleChange::kCleanup:
      return application.clean_up_component(component);
  }
  return component::refused("there is no such change");
}

}  // namespace

ApplicationView::ApplicationView(Application& application, exec::Caller caller)
    : application_(application),
      caller_(caller),
      commands_(std::make_unique<internal::BegunCommands>(kMostCommands)) {}

ApplicationView::~ApplicationView() = default;

Component& ApplicationView::find(const std::string& name) const {
  if (Component* const found = application_.find(name)) return *found;
  throw Refusal(no_component(application_, name));
}

std::vector<std::string> ApplicationView::component_names() {
  return inspect::component_names(application_);
}

ApplicationStatus ApplicationView::status() { return internal::status_of(application_); }

std::vector<ComponentStatus> ApplicationView::components(const Which& which) {
  return internal::statuses_of(application_, chosen(application_, which));
}

Faults ApplicationView::faults(const Which& which) {
  std::vector<Component*> resting = chosen(application_, which);
  std::erase_if(resting,
                [](const Component* one) { return one->state() == component::State::kRunning; });
  return {application_.faults(), application_.reactions(),
          internal::statuses_of(application_, resting)};
}

ComponentDescription ApplicationView::describe(const std::string& name, Values values) {
  Component& component = find(name);
  const bool asked = values == Values::kIncluded;
  const auto snapshot = asked ? snapshot_of(application_, component) : nullptr;
  ComponentDescription description =
      internal::describe_interface(component, snapshot.get(), values);
  static_cast<ComponentStatus&>(description) =
      asked ? internal::statuses_of(application_, {&component}).front()
            : internal::status_without_reason(application_, component);
  description.activity =
      internal::activity_text(internal::thread_of(application_, component).activity);
  return description;
}

std::vector<Connection> ApplicationView::connections(const Which& which) {
  return connections_of(application_.plan(), which);
}

std::vector<ItemValue> ApplicationView::read(const std::vector<std::string>& texts) {
  std::vector<ItemValue> values(texts.size());
  std::map<const Component*, std::vector<std::pair<Item, std::size_t>>> by_component;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const base::Result<Item> item = find_item(application_, texts[i]);
    if (item) {
      by_component[item.value().member.component].emplace_back(item.value(), i);
    } else {
      values[i] = no_value(texts[i], item.error());
    }
  }
  for (const auto& [component, items] : by_component) {
    std::vector<Member> members;
    for (const auto& [item, place] : items) members.push_back(item.member);
    const auto readings = read_members(application_, members);
    for (std::size_t k = 0; k < items.size(); ++k) {
      const auto& [item, place] = items[k];
      values[place] = value_of(item, readings ? &(*readings)[k] : nullptr);
    }
  }
  return values;
}

Watch ApplicationView::watch(const std::vector<std::string>& items, base::Duration interval) {
  Watch watch;
  std::vector<exec::WatchedNumber> numbers;
  for (const std::string& text : items) {
    for (WatchedPlace& place : answer_of(numbers_in(application_, text))) {
      numbers.push_back(std::move(place.number));
      watch.items.push_back({std::move(place.item), std::move(place.unit)});
    }
    if (numbers.size() > kMostNumbers) {
      throw Refusal("at most " + std::to_string(kMostNumbers) + " numbers are watched at once");
    }
  }
  if (numbers.empty()) throw Refusal("a watch needs an item, for example Joint1.Position");
  watch.handle = answer_of(application_.watch(numbers, interval));
  return watch;
}

WatchedValues ApplicationView::watched(std::int32_t handle) {
  const exec::WatchSample* const sample = application_.watched(handle);
  if (sample == nullptr) {
    throw Refusal("unknown watch " + std::to_string(handle) + ": it has ended, or never began");
  }
  WatchedValues values{sample->values, {}, sample->replaced};
  const base::Time now = application_.now();
  for (const base::Time time : sample->times) {
    const bool never = time == base::Time::min();
    values.ages.push_back(never ? std::numeric_limits<double>::quiet_NaN()
                                : std::max(base::to_seconds(now - time), 0.0));
  }
  return values;
}

void ApplicationView::end_watch(std::int32_t handle) { application_.end_watch(handle); }

Cycle ApplicationView::cycle(const std::string& thread, const Which& which) {
  const exec::RecordedCycle found = answer_of(application_.cycle(thread));
  Cycle cycle{found.number, found.time, found.length, {}, found.left_out};
  for (const exec::RecordedCycle::Step& step : found.steps) {
    const std::string name(step.component->name());
    cycle.steps.push_back({which(name) ? name : std::string(), step.begin, step.length});
  }
  return cycle;
}

LogLines ApplicationView::log(std::uint64_t after, const Which& which) {
  LogLines found;
  std::uint64_t next = after + 1;
  for (exec::LogLine& line : application_.log_history().lines_after(after, kMostLogLines)) {
    found.left_out += line.number - next;
    next = line.number + 1;
    if (which(line.component)) {
      found.lines.push_back(std::move(line));
    } else {
      ++found.left_out;
    }
  }
  return found;
}

ItemValue ApplicationView::write(const std::string& text, const std::string& value) {
  const Item item = answer_of(find_item(application_, text));
  const Member& member = item.member;
  const std::string name = member.name();
  answer_of(check_settable(application_, member, caller_));
  if (!item.parts.empty()) {
    throw Refusal("'" + text + "' is a part: set the whole, " + name + " = ...");
  }
  const types::Value wanted = value_from(member.type(), in_unit_of(member, value, name), name);
  answer_of(set(application_, member, wanted, caller_));
  return read({text}).front();
}

CallResult ApplicationView::call(const std::string& component, const std::string& operation,
                                 const std::vector<std::string>& arguments) {
  const Member member = operation_named(application_, component, operation);
  const std::optional<types::Value> result =
      answer_of(inspect::call(application_, member, arguments_of(member, arguments), caller_));
  return result ? CallResult{true, result->type().name, result->text()} : CallResult{};
}

CommandStatus ApplicationView::begin(const std::string& component, const std::string& command,
                                     const std::vector<std::string>& arguments) {
  const Member member = operation_named(application_, component, command);
  std::vector<types::Value> values = arguments_of(member, arguments);
  const std::string name = component + "." + command;
  if (!commands_->make_room()) {
    const bool by_others = caller_ == exec::Caller::kRemote;
    throw Refusal(name + ": " + std::to_string(kMostCommands) + " commands" +
                  (by_others ? " of other processes" : "") +
                  " are under way: cancel some, or wait");
  }
  component::CommandHandle begun =
      answer_of(inspect::begin(application_, member, std::move(values), caller_));
  return follow(commands_->add(name, std::move(begun)).handle);
}

CommandStatus ApplicationView::follow(std::int32_t handle) {
  const internal::BegunCommand* const command = commands_->find(handle);
  if (command == nullptr) throw Refusal(unknown_command(handle));
  CommandStatus status = status_of(command->name, command->state);
  status.handle = handle;
  return status;
}

CommandStatus ApplicationView::cancel(std::int32_t handle) {
  if (internal::BegunCommand* const command = commands_->find(handle)) command->state.cancel();
  return follow(handle);
}

ComponentStatus ApplicationView::change(const std::string& name, LifeCycleChange change) {
  Component& component = find(name);
  const component::Outcome outcome = apply(application_, name, change);
  if (!outcome) throw Refusal(with_name(name, std::string(outcome.reason())));
  return internal::statuses_of(application_, {&component}).front();
}

exec::Pace ApplicationView::pace() { return application_.pace(); }

exec::Pace ApplicationView::set_pace(const exec::Pace& pace) {
  answer_of(application_.set_pace(pace));
  return application_.pace();
}

exec::Pace ApplicationView::step() {
  answer_of(application_.step());
  return application_.pace();
}

bool ApplicationView::remembers(std::int32_t handle) const {
  return commands_->find(handle) != nullptr;
}

bool ApplicationView::is_under_way(std::int32_t handle) const {
  const internal::BegunCommand* const command = commands_->find(handle);
  return command != nullptr && !command->state.ended();
}

std::string ApplicationView::unknown_command(std::int32_t handle) {
  return "unknown command handle " + std::to_string(handle) +
         ": it never began, or has ended and its result is no longer kept";
}

}  // namespace armature::inspect
