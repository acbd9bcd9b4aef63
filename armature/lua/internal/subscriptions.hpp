// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <lua5.4/lua.hpp>

#include "armature/component/events/event.hpp"
#include "armature/lua/internal/events.hpp"
#include "armature/lua/internal/schedule.hpp"

namespace armature::lua::internal {

/// Makes Lua know events of components, and gives it `on(event, function)`.
void install_subscriptions(lua_State* lua, Schedule& schedule);

/// What `Arming.Stop` is in Lua.
void push_event(lua_State* lua, component::EventBase& event);
/// nullptr if there is none at `index`.
component::EventBase* event_at(lua_State* lua, int index);
/// `Arming.Stop`.
std::string name_of(const component::EventBase& event);

/// `Events::listen`, which refuses if it cannot.
Events::Id listen(lua_State* lua, Events& events, component::EventBase& event,
                  Events::Listener listener);

}  // namespace armature::lua::internal
