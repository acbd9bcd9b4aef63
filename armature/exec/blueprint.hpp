// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/component/component.hpp"
#include "armature/component/ports/port.hpp"
#include "armature/exec/activity.hpp"

namespace armature::exec {

/// A peer by its name.
struct PeerEntry {
  std::string name;
  base::Location where;
  bool superior = false;  ///< commands the component, which uses it nevertheless
};

/// Says which peer serves a requirement where several could: `sensorRead: aic1.sensorRead`.
struct BindingEntry {
  std::string requirement;
  std::string peer;
  std::string member;  ///< empty: the same name
  base::Location where;
};

/// A component and how it runs.
struct ComponentEntry {
  std::unique_ptr<component::Component> component;
  std::string model;
  Activity activity;
  std::vector<PeerEntry> peers;
  std::vector<BindingEntry> bindings;
  base::Location where;
  bool autostart = true;      ///< false: only `Application::start_component` starts it
  bool autoconfigure = true;  ///< false: it is configured only then, too
  bool shadow = false;        ///< looks on and moves nothing: exec/internal/plan_shadows.cpp
};

/// A connection by the names of its ends.
struct ConnectionEntry {
  std::string from_component;
  std::string from_port;
  std::string to_component;
  std::string to_port;
  component::ConnectionPolicy policy;
  std::optional<component::MaxAge> max_age;
  std::optional<component::OnLost> on_lost;
  base::Location where;
};

/// A component that belongs to a mode, by its name.
struct ModeMember {
  std::string component;
  base::Location where;
};

/// Components that run together, and not in other modes unless those name them too.
struct ModeEntry {
  std::string name;
  std::vector<ModeMember> members;
  base::Location where;
};

/// What an application consists of, before anything is checked: components with their activities
/// and peers, the connections between their ports, and its modes. Locations lead diagnostics to the
/// user's file.
struct Blueprint {
  std::string name = "application";
  std::vector<ComponentEntry> components;
  std::vector<ConnectionEntry> connections;
  std::vector<ModeEntry> modes;  ///< a component that none of them names runs in all
  ModeMember initial_mode;       ///< empty: the first
  /// Components that could not be made, which was reported: what refers to them is not checked.
  std::unordered_set<std::string> absent;

  /// For applications that are written in C++.
  template <typename ComponentClass>
  ComponentClass& add(std::string component_name, Activity activity = Activity::sequential()) {
    auto made = std::make_unique<ComponentClass>(std::move(component_name));
    ComponentClass& component = *made;
    components.push_back({std::move(made), {}, std::move(activity), {}, {}, {}});
    return component;
  }
  /// `from` and `to` are written `Component.Port`.
  void connect(std::string_view from, std::string_view to, component::ConnectionPolicy policy = {});
  /// `user` may use the operations, events and properties of `used`, not the other way round.
  void add_peer(std::string_view user, std::string_view used);
  /// Adds a mode and, with the first one, the component `Modes`, which switches between them.
  void add_mode(std::string mode_name, std::vector<ModeMember> members, base::Location where = {});
};

}  // namespace armature::exec
