// SPDX-License-Identifier: Apache-2.0
#pragma once

// What texts like `Joint1`, `Sensor.sensor[2]` and `Settings.Gains.kp` name in an application.
// Functions that do not read values look only at what is fixed once the application is made, so any
// thread may call them.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/component/author.hpp"
#include "armature/exec/application.hpp"

namespace armature::inspect {

std::vector<std::string> component_names(const exec::Application& application);

/// The component with the longest name that `text` is, or begins with before one of `separators`;
/// nullptr if there is none.
component::Component* leading_component(const exec::Application& application, std::string_view text,
                                        std::string_view separators);

/// Why there is none, with the nearest name.
std::string no_component(const exec::Application& application, std::string_view text);

/// A member of a component; one of the pointers is set.
struct Member {
  const component::Component* component = nullptr;
  const component::PropertyBase* property = nullptr;
  const component::InputPortBase* input = nullptr;
  const component::OutputPortBase* output = nullptr;
  const component::OperationBase* operation = nullptr;
  component::EventBase* event = nullptr;

  std::string name() const;  ///< with its component
  bool has_value() const { return property != nullptr || port() != nullptr; }
  const component::PortBase* port() const;
  const types::Type& type() const;  ///< of its value
  std::string_view unit() const;
};

/// The names of a component's members, for suggestions.
std::vector<std::string> member_names(const component::Component& component);

/// The member of that name; nothing if there is none.
std::optional<Member> member_of(const component::Component& component, std::string_view name);

/// The member that `text` names, `Component.member` or `Component:member`; else why there is none.
base::Result<Member> find_member(const exec::Application& application, std::string_view text);

/// A member's value or a part of it: `Sensor.sensor[2]`, `Settings.Gains.kp`.
struct Item {
  using Part = std::variant<std::size_t, const types::Field*>;  ///< counted from 0
  std::string text;
  Member member;
  std::vector<Part> parts;
  const types::Type* type = nullptr;
  std::string unit;
};
base::Result<Item> find_item(const exec::Application& application, std::string_view text);

/// A value as its component's thread had it at one moment.
struct Reading {
  types::Value whole;
  bool written = true;  ///< false: nobody wrote the port yet
  base::Duration age{};
  std::uint64_t sequence = 0;  ///< of a port: how many values were written
};
/// A place for a member's value.
Reading room_for(const Member& member);
/// Copies a member's value into its place.
/// @thread the component's own
void take_reading(const Member& member, base::Time now, Reading& to);

/// Reads values of one component, by its own thread, all at one moment; nothing if its thread does
/// not answer.
std::optional<std::vector<Reading>> read_members(exec::Application& application,
                                                 const std::vector<Member>& members);

/// A number in a component, for `exec::Application::watch`.
struct WatchedPlace {
  std::string item;  ///< that names it alone
  std::string unit;
  exec::WatchedNumber number;
};

/// All numbers that the item has now; an error if it has none, or its thread does not answer.
base::Result<std::vector<WatchedPlace>> numbers_in(exec::Application& application,
                                                   std::string_view item);

/// Where the part of `item` is in a reading of its member; nullptr if the list is not so long.
const void* part_of(const Item& item, const types::Value& whole);

}  // namespace armature::inspect
