// SPDX-License-Identifier: Apache-2.0
#include "armature/runner/assembly.hpp"

#include <exception>
#include <filesystem>
#include <memory>

#include "armature/base/near_name.hpp"
#include "armature/base/quoted.hpp"
#include "armature/component/interface.hpp"
#include "armature/platform/child_process.hpp"

namespace armature::runner {

namespace {

template <typename Member>
Member* find_member(const std::vector<Member*>& members, std::string_view name) {
  for (Member* const member : members) {
    if (member->name() == name) return member;
  }
  return nullptr;
}

struct Ends {
  std::string component;
  std::string member;
};

/// Parts of composites have dots in their names, members have none.
Ends split(std::string_view reference) {
  const std::size_t dot = reference.rfind('.');
  if (dot == std::string_view::npos) return {std::string(reference), {}};
  return {std::string(reference.substr(0, dot)), std::string(reference.substr(dot + 1))};
}

std::unique_ptr<component::Component> make(const component::Registry::Model& model,
                                           const std::string& name, std::string& problem) {
  problem = "returns no component";
  try {
    return model.make(name);
  } catch (const std::exception& exception) {
    problem = std::string("threw ") + exception.what();
  } catch (...) {
    problem = "threw an object that is not a std::exception";
  }
  return nullptr;
}

}  // namespace

// ---- A component

Part& Part::set_text(std::string_view property, std::string_view text) {
  exec::ComponentEntry* const entry = assembly_.entry(index_);
  if (entry == nullptr) return *this;
  auto* const found = find_member(component::interface_of(*entry->component).properties, property);
  if (found == nullptr) return give(property, types::Value::of(false));  // which tells it
  types::Value value(found->type());
  const auto read = types::from_text(found->type(), text, value.data());
  if (read) return give(property, value);
  assembly_.mistake(base::quoted(entry->component->name() + "." + std::string(property)) + ": " +
                    read.error());
  return *this;
}

Part& Part::give(std::string_view property, const types::Value& value) {
  exec::ComponentEntry* const entry = assembly_.entry(index_);
  if (entry == nullptr) return *this;
  const std::string item = base::quoted(entry->component->name() + "." + std::string(property));
  auto* const found = find_member(component::interface_of(*entry->component).properties, property);
  if (found == nullptr) {
    assembly_.mistake("unknown property " + item + " (" + entry->model + ")");
  } else if (!types::same_type(found->type(), value.type())) {
    assembly_.mistake(item + " is of type " + found->type().name + ", found a " +
                      value.type().name);
  } else if (const auto set = found->set(value); !set) {
    assembly_.mistake(item + ": " + set.error());
  }
  return *this;
}

Part& Part::activity(exec::Activity activity) {
  if (auto* const entry = assembly_.entry(index_)) entry->activity = std::move(activity);
  return *this;
}

Part& Part::peer(std::string_view name) {
  if (auto* const entry = assembly_.entry(index_)) entry->peers.push_back({std::string(name), {}});
  return *this;
}

Part& Part::superior(std::string_view name) {
  if (auto* const entry = assembly_.entry(index_)) {
    entry->peers.push_back({std::string(name), {}, true});
  }
  return *this;
}

Part& Part::bind(std::string_view requirement, std::string_view peer, std::string_view member) {
  if (auto* const entry = assembly_.entry(index_)) {
    entry->bindings.push_back(
        {std::string(requirement), std::string(peer), std::string(member), {}});
  }
  return *this;
}

Part& Part::shadow() {
  if (auto* const entry = assembly_.entry(index_)) entry->shadow = true;
  return *this;
}

Part& Part::autostart(bool yes) {
  if (auto* const entry = assembly_.entry(index_)) entry->autostart = yes;
  return *this;
}

Part& Part::autoconfigure(bool yes) {
  if (auto* const entry = assembly_.entry(index_)) entry->autoconfigure = yes;
  return *this;
}

// ---- A connection

Wire& Wire::max_age(base::Duration age, component::Reaction reaction) {
  assembly_.blueprint_.connections[index_].max_age = component::max_age(age, reaction);
  return *this;
}

Wire& Wire::on_lost(component::Reaction reaction) {
  assembly_.blueprint_.connections[index_].on_lost = component::on_lost(reaction);
  return *this;
}

// ---- A command

ParameterGiven member(std::size_t number) { return {.member = number}; }

ParameterGiven port(std::string input, std::string output) {
  return {.input = std::move(input), .port = std::move(output)};
}

ParameterGiven text_constant(std::string text) { return {.text = std::move(text)}; }

std::optional<component::CallParameter> Assembly::resolve(const ParameterGiven& given,
                                                          const types::Type& wanted,
                                                          const component::Signature& event) {
  using From = component::CallParameter::From;
  component::CallParameter made;
  if (given.member) {
    made.member = *given.member;
    const auto& members = event.arguments;
    const bool fits = made.member < members.size() &&
                      component::CallParameters::takes(wanted, *members[made.member].type);
    if (fits) return made;
    mistake("the event's member " + std::to_string(made.member) + " is no " + wanted.name);
    return std::nullopt;
  }
  if (!given.port.empty()) {
    const Ends end = split(given.port);
    const component::Component* const owner = find(end.component);
    if (owner == nullptr) return std::nullopt;
    made.from = From::kPort;
    made.input = given.input;
    made.port = find_member(component::interface_of(*owner).outputs, end.member);
    if (made.port != nullptr) return made;
    mistake("unknown output " + base::quoted(given.port));
    return std::nullopt;
  }
  types::Value value = given.constant.value_or(types::Value(wanted));
  if (!given.constant) {
    const auto read = types::from_text(wanted, given.text, value.data());
    if (!read) return mistake("a parameter: " + read.error()), std::nullopt;
  }
  made.from = From::kConstant;
  made.constant = std::make_shared<const types::Value>(std::move(value));
  return made;
}

void Assembly::command(const CommandGiven& given, std::vector<ParameterGiven> parameters) {
  const Ends on = split(given.on);
  const Ends give = split(given.give);
  const component::Component* const raiser = find(on.component);
  const component::Component* const server = find(give.component);
  if (raiser == nullptr || server == nullptr) return;
  const auto* const event = find_member(component::interface_of(*raiser).events, on.member);
  const auto* const found = find_member(component::interface_of(*server).operations, give.member);
  if (event == nullptr) return mistake("unknown event " + base::quoted(given.on));
  if (found == nullptr || !found->is_command() || found->is_by_operator()) {
    return mistake(base::quoted(given.give) + " is no command that an event may give");
  }
  const auto& wanted = found->signature().arguments;
  if (wanted.size() != parameters.size()) {
    return mistake(base::quoted(given.give) + " takes " + std::to_string(wanted.size()) +
                   " parameters, found " + std::to_string(parameters.size()));
  }
  std::vector<component::CallParameter> all;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    auto one = resolve(parameters[i], *wanted[i].type, event->signature());
    if (!one) return;
    all.push_back(std::move(*one));
  }
  blueprint_.components.push_back(exec::event_command_entry(
      given.name, *event, static_cast<const component::CommandBase&>(*found), std::move(all),
      given.max_age));
}

// ---- All of them

Part Assembly::component(std::string name, const std::string& model) {
  const component::Registry::Model* const known = models_.find(model);
  std::string problem;
  auto made = known == nullptr ? nullptr : make(*known, name, problem);
  if (made == nullptr) {
    mistake(base::quoted(name) + (known == nullptr
                                      ? " has the unknown model " + base::quoted(model) +
                                            base::suggestion_in_brackets(model, models_.names())
                                      : ": the model " + base::quoted(model) + " " + problem));
    return {*this, blueprint_.components.max_size()};
  }
  blueprint_.components.push_back({std::move(made), model, {}, {}, {}, {}});
  return {*this, blueprint_.components.size() - 1};
}

Wire Assembly::connect(std::string_view from, std::string_view to,
                       component::ConnectionPolicy policy) {
  blueprint_.connect(from, to, policy);
  return {*this, blueprint_.connections.size() - 1};
}

void Assembly::mode(std::string name, const std::vector<std::string>& members) {
  std::vector<exec::ModeMember> all;
  for (const std::string& each : members) all.push_back({each, {}});
  blueprint_.add_mode(std::move(name), std::move(all));
}

std::string Assembly::file(std::string_view name) {
  const std::filesystem::path program = platform::own_program();
  return (program.parent_path() / "data" / name).string();
}

exec::ComponentEntry* Assembly::entry(std::size_t index) {
  return index < blueprint_.components.size() ? &blueprint_.components[index] : nullptr;
}

component::Component* Assembly::find(std::string_view name) {
  for (const exec::ComponentEntry& each : blueprint_.components) {
    if (each.component->name() == name) return each.component.get();
  }
  mistake("unknown component " + base::quoted(name));
  return nullptr;
}

}  // namespace armature::runner
