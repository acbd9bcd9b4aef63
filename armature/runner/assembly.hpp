// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/base/time.hpp"
#include "armature/component/registry.hpp"
#include "armature/exec/activity.hpp"
#include "armature/exec/application_options.hpp"
#include "armature/exec/blueprint.hpp"
#include "armature/exec/event_command.hpp"
#include "armature/types/type.hpp"

namespace armature::runner {

class Assembly;

/// A component of an assembly, while it is described. Calls after a mistake have no effect.
class Part {
 public:
  Part(Assembly& assembly, std::size_t index) : assembly_(assembly), index_(index) {}

  /// Sets a property of exactly this type.
  template <typename T>
  Part& set(std::string_view property, const T& value) {
    return give(property, types::Value::of(value));
  }
  Part& set(std::string_view property, const char* text) {
    return set(property, std::string(text));
  }
  /// Sets a property of a type that only its component library knows.
  /// @param text  as `types::to_text` writes it
  Part& set_text(std::string_view property, std::string_view text);
  Part& activity(exec::Activity activity);
  /// It may use the operations, events and properties of this one.
  Part& peer(std::string_view name);
  /// The same of one that commands it, though it uses that one.
  Part& superior(std::string_view name);
  /// @param member  of the peer; empty: called as the requirement
  Part& bind(std::string_view requirement, std::string_view peer, std::string_view member);
  Part& autostart(bool yes);
  Part& autoconfigure(bool yes);
  /// It looks on and moves nothing.
  Part& shadow();

 private:
  Part& give(std::string_view property, const types::Value& value);

  Assembly& assembly_;
  std::size_t index_;
};

/// A connection of an assembly, while it is described.
class Wire {
 public:
  Wire(Assembly& assembly, std::size_t index) : assembly_(assembly), index_(index) {}

  Wire& max_age(base::Duration age, component::Reaction reaction);
  Wire& on_lost(component::Reaction reaction);

 private:
  Assembly& assembly_;
  std::size_t index_;
};

/// An event and the command that it gives, each written `Component.Member`.
struct CommandGiven {
  std::string name;  ///< of the component that gives it
  std::string on;
  std::string give;
  base::Duration max_age{};  ///< of what comes from ports; 0: any
};

/// Where a parameter of a command comes from: made by the functions below.
struct ParameterGiven {
  std::optional<std::size_t> member{};
  std::string input{};
  std::string port{};
  std::optional<types::Value> constant{};
  std::string text{};
};
/// The event's member with this number, from 0.
ParameterGiven member(std::size_t number);
/// What the output `Component.Port` holds; the component that gives the command calls it `input`.
ParameterGiven port(std::string input, std::string output);
template <typename T>
ParameterGiven constant(const T& value) {
  return {.constant = types::Value::of(value)};
}
/// Of a type that only a component library knows, as `types::to_text` writes it.
ParameterGiven text_constant(std::string text);

/// An application that is put together by code instead of a deployment's file: what generated
/// programs are written in. Its mistakes are collected; the names are resolved, and everything else
/// is checked, when the application starts.
/// @thread configuration only
class Assembly {
 public:
  /// @param models  outlive it
  explicit Assembly(const component::Registry& models) : models_(models) {}

  void name(std::string application) { blueprint_.name = std::move(application); }
  Part component(std::string name, const std::string& model);
  /// `from` and `to` are written `Component.Port`.
  Wire connect(std::string_view from, std::string_view to, component::ConnectionPolicy policy = {});
  /// Connections to the ports that its parameters come from are made on their own.
  void command(const CommandGiven& given, std::vector<ParameterGiven> parameters = {});
  void mode(std::string name, const std::vector<std::string>& members);
  void initial_mode(std::string name) { blueprint_.initial_mode = {std::move(name), {}}; }
  /// The path of a data file that lies in the folder `data` beside the program.
  std::string file(std::string_view name);

  exec::ApplicationOptions& options() { return options_; }
  const exec::Blueprint& blueprint() const { return blueprint_; }
  const base::Diagnostics& mistakes() const { return mistakes_; }
  /// Hands over what was put together.
  exec::Blueprint take_blueprint() { return std::move(blueprint_); }

 private:
  friend class Part;
  friend class Wire;

  exec::ComponentEntry* entry(std::size_t index);
  component::Component* find(std::string_view name);
  std::optional<component::CallParameter> resolve(const ParameterGiven& given,
                                                  const types::Type& wanted,
                                                  const component::Signature& event);
  void mistake(std::string text) { mistakes_.error({}, std::move(text)); }

  const component::Registry& models_;
  exec::Blueprint blueprint_;
  exec::ApplicationOptions options_;
  base::Diagnostics mistakes_;
};

}  // namespace armature::runner
