// SPDX-License-Identifier: Apache-2.0
#pragma once

// What texts like `Joint1`, `Sensor.sensor[2]` and `Settings.Gains.kp` name, also as Lua spells
// them.

#include <string>
#include <string_view>

#include "armature/inspect/items.hpp"

namespace armature::browser::internal {

using inspect::component_names;
using inspect::Item;
using inspect::Member;
using inspect::no_component;
using inspect::part_of;
using inspect::read_members;
using inspect::Reading;

/// The text with what Lua needs for the component that it begins with, if that has a name which
/// Lua would misread; `_G["aic-1"].Gain` for `aic-1.Gain`.
std::string spelled_for_lua(const exec::Application& application, std::string_view text);

/// As those of `remote`; `text` may be quoted or written as Lua has it.
component::Component* find_component(const exec::Application& application, std::string_view text);
base::Result<Member> find_member(const exec::Application& application, std::string_view text);
base::Result<Item> find_item(const exec::Application& application, std::string_view text);

}  // namespace armature::browser::internal
