// SPDX-License-Identifier: Apache-2.0
#include "armature/lua/internal/subscriptions.hpp"

#include <string>
#include <utility>

#include "armature/lua/internal/components.hpp"
#include "armature/lua/internal/values.hpp"

namespace armature::lua::internal {
namespace {

constexpr const char* kEvent = "event";
constexpr const char* kSubscription = "subscription";

/// Calls of a function of Lua, for as long as it is not cancelled.
struct Subscription {
  Events* events;
  Events::Id id;
  int function;
};

Subscription& checked_subscription(lua_State* lua) {
  return *static_cast<Subscription*>(luaL_checkudata(lua, 1, kSubscription));
}

int cancel(lua_State* lua) {
  Subscription& subscription = checked_subscription(lua);
  subscription.events->forget(std::exchange(subscription.id, Events::kNobody));
  luaL_unref(lua, LUA_REGISTRYINDEX, std::exchange(subscription.function, LUA_NOREF));
  return 0;
}

int subscription_text(lua_State* lua) {
  const bool active = checked_subscription(lua).id != Events::kNobody;
  lua_pushstring(lua, active ? "subscription (active)" : "subscription (cancelled)");
  return 1;
}

int event_text(lua_State* lua) {
  const std::string name = name_of(**static_cast<component::EventBase**>(lua_touserdata(lua, 1)));
  lua_pushlstring(lua, name.data(), name.size());
  return 1;
}

/// Each time that the event is raised, the function begins as a part of the script.
int on(lua_State* lua) {
  auto& schedule = *static_cast<Schedule*>(lua_touserdata(lua, lua_upvalueindex(1)));
  component::EventBase* const event = event_at(lua, 1);
  if (event == nullptr || lua_type(lua, 2) != LUA_TFUNCTION || lua_gettop(lua) != 2) {
    refuse(lua, "on takes an event and a function: on(Arming.Stop, function() ... end)" +
                    (event == nullptr && lua_gettop(lua) > 0 && lua_type(lua, 1) != LUA_TFUNCTION
                         ? ", found " + (lua_isnil(lua, 1) ? "nothing" : text_at(lua, 1))
                         : std::string()));
  }
  auto* const subscription =
      static_cast<Subscription*>(lua_newuserdatauv(lua, sizeof(Subscription), 0));
  *subscription = {&schedule.events(), Events::kNobody, LUA_NOREF};
  luaL_setmetatable(lua, kSubscription);
  lua_pushvalue(lua, 2);
  const int function = luaL_ref(lua, LUA_REGISTRYINDEX);
  subscription->function = function;
  subscription->id =
      listen(lua, schedule.events(), *event,
             [&schedule, function](lua_State* to, const Events::Arguments& arguments) {
               lua_rawgeti(to, LUA_REGISTRYINDEX, function);
               schedule.add(to, push_arguments(to, arguments));
             });
  return 1;
}

void make_type(lua_State* lua, const char* name, lua_CFunction text) {
  luaL_newmetatable(lua, name);
  lua_pushcfunction(lua, text);
  lua_setfield(lua, -2, "__tostring");
  lua_pushstring(lua, name);
  lua_setfield(lua, -2, "__metatable");
}

}  // namespace

void install_subscriptions(lua_State* lua, Schedule& schedule) {
  make_type(lua, kEvent, event_text);
  lua_pop(lua, 1);
  make_type(lua, kSubscription, subscription_text);
  lua_createtable(lua, 0, 1);
  lua_pushcfunction(lua, cancel);
  lua_setfield(lua, -2, "cancel");
  lua_setfield(lua, -2, "__index");
  lua_pop(lua, 1);
  lua_pushlightuserdata(lua, &schedule);
  lua_pushcclosure(lua, on, 1);
  lua_setglobal(lua, "on");
}

void push_event(lua_State* lua, component::EventBase& event) {
  auto** const place =
      static_cast<component::EventBase**>(lua_newuserdatauv(lua, sizeof(component::EventBase*), 0));
  *place = &event;
  luaL_setmetatable(lua, kEvent);
}

component::EventBase* event_at(lua_State* lua, int index) {
  void* const place = luaL_testudata(lua, index, kEvent);
  return place == nullptr ? nullptr : *static_cast<component::EventBase**>(place);
}

std::string name_of(const component::EventBase& event) {
  return event.owner().name() + "." + std::string(event.name());
}

Events::Id listen(lua_State* lua, Events& events, component::EventBase& event,
                  Events::Listener listener) {
  if (events.is_full())
    refuse(lua, "a script has at most 1000 functions and waits for events at once: cancel some");
  const Events::Id id = events.listen(event, std::move(listener));
  if (id == Events::kNobody) {
    refuse(lua, name_of(event) + ": the thread of '" + event.owner().name() + "' does not answer");
  }
  return id;
}

}  // namespace armature::lua::internal
