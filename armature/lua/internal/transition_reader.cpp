// SPDX-License-Identifier: Apache-2.0
#include "armature/lua/internal/transition_reader.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "armature/base/near_name.hpp"
#include "armature/base/seconds.hpp"
#include "armature/lua/internal/subscriptions.hpp"
#include "armature/lua/internal/values.hpp"

namespace armature::lua::internal {
namespace {

using component::kNoState;
using component::MachineTransition;

constexpr std::size_t kMostTransitions = 5000;
const std::vector<std::string> kOptions = {"action", "back_to", "guard"};

/// What stands before the target.
int places_before_target(MachineTransition::Cause kind) {
  return kind == MachineTransition::Cause::kTime || kind == MachineTransition::Cause::kCondition;
}

const char* form_of(MachineTransition::Cause kind) {
  switch (kind) {
    case MachineTransition::Cause::kTime:
      return "{5.0, \"Idle\"}";
    case MachineTransition::Cause::kCondition:
      return "{function() return ... end, \"Idle\"}";
    case MachineTransition::Cause::kDone:
      return "\"Idle\" or {\"Idle\", guard = ...}";
    case MachineTransition::Cause::kTrigger:
      break;
  }
  return "\"Idle\", a function, or {\"Idle\", guard = ..., action = ...}";
}

}  // namespace

void TransitionReader::read(int table, int state, const std::string& place) {
  if (reader_.get(table, "on")) read_on(lua_gettop(lua_), state, place);
  lua_pop(lua_, 1);
  if (reader_.get(table, "failed")) definition_.failed = trigger("the failure of run", {});
  lua_pop(lua_, 1);
  MachineDefinition::State& own = definition_.states[static_cast<std::size_t>(state)];
  const bool runs = own.run != LUA_NOREF;
  if (runs && reader_.get(table, "done")) {
    own.done = trigger("the end of run of " + definition_.table.path(state), {});
  }
  if (runs) lua_pop(lua_, 1);
  read_reaction(table, "failed", place,
                {state, MachineTransition::Cause::kTrigger, definition_.failed});
  read_reaction(table, "done", place,
                {state, runs ? MachineTransition::Cause::kTrigger : MachineTransition::Cause::kDone,
                 own.done});
  read_reaction(table, "after", place, {state, MachineTransition::Cause::kTime, kNoTrigger});
  read_reaction(table, "when", place, {state, MachineTransition::Cause::kCondition, kNoTrigger});
}

std::size_t TransitionReader::trigger(const std::string& name, MachineDefinition::Trigger how) {
  std::vector<std::string>& names = definition_.table.triggers;
  const auto known = std::find(names.begin(), names.end(), name);
  if (known != names.end()) return static_cast<std::size_t>(known - names.begin());
  names.push_back(name);
  definition_.triggers.push_back(how);
  return names.size() - 1;
}

/// Events are other objects of Lua each time that they are named.
void TransitionReader::read_on(int table, int state, const std::string& place) {
  if (!lua_istable(lua_, table)) {
    reader_.complain(place, "on must be a table, on = {go = \"Moving\"}, found " + reader_.top());
    return;
  }
  std::map<std::string, std::pair<component::EventBase*, int>> causes;
  for (lua_pushnil(lua_); lua_next(lua_, table) != 0;) {
    component::EventBase* const event = event_at(lua_, -2);
    const bool named = event != nullptr || lua_type(lua_, -2) == LUA_TSTRING;
    const std::string name = named ? text_at(lua_, -2) : std::string();
    const int value = luaL_ref(lua_, LUA_REGISTRYINDEX);
    if (name.empty()) {
      reader_.complain(place, "on takes events and texts: {[Arming.Stop] = \"Idle\", go = \"On\"}");
    } else if (event == nullptr && (name == "done" || name == "failed")) {
      reader_.complain(place, "'" + name + "' stands beside on, not in it");
    } else if (!causes.try_emplace(name, event, value).second) {
      reader_.complain(place, "on has '" + name + "' twice");
    }
  }
  for (const auto& [name, cause] : causes) {
    lua_rawgeti(lua_, LUA_REGISTRYINDEX, cause.second);
    luaL_unref(lua_, LUA_REGISTRYINDEX, cause.second);
    const std::size_t index = trigger(name, {cause.first, cause.first == nullptr});
    read_alternatives(place + ": on '" + name + "'",
                      {state, MachineTransition::Cause::kTrigger, index});
    lua_pop(lua_, 1);
  }
}

void TransitionReader::read_reaction(int table, const char* key, const std::string& place,
                                     const Cause& cause) {
  if (reader_.get(table, key)) read_alternatives(place + ": " + key, cause);
  lua_pop(lua_, 1);
}

/// One transition on top of the stack, or a list of them, which are tried in turn.
void TransitionReader::read_alternatives(const std::string& place, const Cause& cause) {
  const int value = lua_gettop(lua_);
  const int before = places_before_target(cause.kind);
  bool list = false;
  if (lua_istable(lua_, value)) {
    const int first = lua_rawgeti(lua_, value, 1);
    list = first == LUA_TTABLE || (before == 0 && first == LUA_TFUNCTION) ||
           static_cast<int>(lua_rawlen(lua_, value)) > before + 1;
    lua_pop(lua_, 1);
  }
  if (!list) {
    read_one(place, cause);
    return;
  }
  const auto count = static_cast<int>(lua_rawlen(lua_, value));
  for (const std::string& key : reader_.keys(value, place, count)) {
    reader_.complain_of_key(place, key, {}, ": it belongs in one of the transitions");
  }
  for (int i = 1; i <= count; ++i) {
    lua_rawgeti(lua_, value, i);
    read_one(place + "[" + std::to_string(i) + "]", cause);
    lua_pop(lua_, 1);
  }
}

void TransitionReader::read_one(const std::string& place, const Cause& cause) {
  if (pending_.size() >= kMostTransitions) {
    reader_.complain(place, "it is one too many: a machine has at most 5000 transitions");
    return;
  }
  Pending pending;
  pending.place = place;
  pending.transition.source = cause.state;
  pending.transition.cause = cause.kind;
  if (cause.trigger != kNoTrigger) pending.transition.trigger = cause.trigger;
  const bool plain = places_before_target(cause.kind) == 0;
  if (lua_istable(lua_, -1)) {
    read_table(lua_gettop(lua_), pending);
  } else if (plain && reader_.is(LUA_TSTRING)) {
    pending.target = lua_tostring(lua_, -1);
    pending_.push_back(pending);
  } else if (plain && reader_.is(LUA_TFUNCTION)) {
    lua_pushvalue(lua_, -1);
    MachineFunction* const action = keep(luaL_ref(lua_, LUA_REGISTRYINDEX), pending.transition);
    pending.transition.action = {&MachineFunction::perform, action, {}};
    pending_.push_back(pending);
  } else {
    reader_.complain(place,
                     "must be " + std::string(form_of(cause.kind)) + ", found " + reader_.top());
  }
}

void TransitionReader::read_table(int table, Pending& pending) {
  const int before = places_before_target(pending.transition.cause);
  for (const std::string& key : reader_.keys(table, pending.place, before + 1)) {
    const bool known = std::find(kOptions.begin(), kOptions.end(), key) != kOptions.end();
    if (!known) reader_.complain_of_key(pending.place, key, kOptions);
  }
  if (before == 1 && !read_first(table, pending)) return;
  read_target(table, before + 1, pending);
  if (reader_.get(table, "guard")) pending.guard = lua_topointer(lua_, -1);
  lua_pop(lua_, 1);
  const int guard = reader_.function(table, "guard", pending.place);
  if (guard != LUA_NOREF && pending.transition.cause == MachineTransition::Cause::kCondition) {
    reader_.complain(pending.place, "its condition is the guard: write `a and b`");
  } else if (guard != LUA_NOREF) {
    pending.transition.guard = {&MachineFunction::ask, keep(guard, pending.transition), {}};
  }
  const int action = reader_.function(table, "action", pending.place);
  if (action != LUA_NOREF) {
    pending.transition.action = {&MachineFunction::perform, keep(action, pending.transition), {}};
  }
  pending_.push_back(pending);
}

/// The time or the condition.
bool TransitionReader::read_first(int table, Pending& pending) {
  lua_rawgeti(lua_, table, 1);
  Transition& transition = pending.transition;
  const double seconds = reader_.is(LUA_TNUMBER) ? lua_tonumber(lua_, -1) : 0.0;
  const bool time = transition.cause == MachineTransition::Cause::kTime && seconds >= 1e-9 &&
                    seconds <= kLongestSeconds;
  const bool condition =
      transition.cause == MachineTransition::Cause::kCondition && reader_.is(LUA_TFUNCTION);
  if (!time && !condition) {
    const std::string wanted = transition.cause == MachineTransition::Cause::kTime
                                   ? "a number of seconds above 0"
                                   : "a function";
    reader_.complain(pending.place, "must begin with " + wanted + ", " + form_of(transition.cause) +
                                        ", found " + reader_.top());
  }
  if (time) transition.after = base::from_seconds(seconds);
  if (!condition) {
    lua_pop(lua_, 1);
    return time;
  }
  MachineFunction* const guard = keep(luaL_ref(lua_, LUA_REGISTRYINDEX), transition);
  transition.guard = {&MachineFunction::ask, guard, {}};
  return true;
}

void TransitionReader::read_target(int table, int position, Pending& pending) {
  lua_rawgeti(lua_, table, position);
  const bool there = !lua_isnil(lua_, -1);
  if (reader_.is(LUA_TSTRING)) {
    pending.target = lua_tostring(lua_, -1);
  } else if (there) {
    reader_.complain(pending.place, "the state to go to must be a text, found " + reader_.top());
  }
  lua_pop(lua_, 1);
  const std::string back = reader_.text(table, "back_to", pending.place);
  if (back.empty()) return;
  if (there)
    reader_.complain(pending.place, "it has both a state to go to and back_to: leave one out");
  pending.target = back;
  pending.transition.to_history = true;
}

MachineFunction* TransitionReader::keep(int reference, const Transition& transition) {
  const bool triggered = transition.cause == MachineTransition::Cause::kTrigger;
  return &definition_.functions.emplace_back(
      MachineFunction{MachineFunction::Kind::kTransition, reference, transition.source,
                      triggered ? transition.trigger : kNoTrigger, nullptr});
}

// --- once all is read ----------------------------------------------------------------------------

void TransitionReader::finish() {
  if (definition_.table.states.empty() && !definition_.problems.empty()) return;
  for (Pending& pending : pending_) {
    if (resolve(pending)) {
      definition_.table.transitions.push_back(pending.transition);
    } else {
      definition_.knows_all_ways = false;
    }
  }
  check_fights();
  std::vector<std::string> problems = component::check_table(definition_.table);
  // Perhaps the name that is none meant such a state.
  if (!definition_.knows_all_ways) {
    std::erase_if(problems, [](const auto& one) { return one.ends_with(" is never entered"); });
  }
  for (const std::string& problem : problems) reader_.complain("", problem);
}

bool TransitionReader::resolve(Pending& pending) {
  if (pending.target.empty()) return true;
  component::MachineTable& table = definition_.table;
  pending.transition.target = table.find(pending.target, pending.transition.source);
  if (pending.transition.target != kNoState) return true;
  if (reader_.has_said_enough()) return false;
  std::vector<std::string> known;
  for (int i = 0; i < static_cast<int>(table.states.size()); ++i) {
    known.push_back(table.states[static_cast<std::size_t>(i)].name);
    if (table.states[static_cast<std::size_t>(i)].parent != kNoState)
      known.push_back(table.path(i));
  }
  reader_.complain(pending.place, "unknown state '" + pending.target + "' to go to from here" +
                                      base::suggestion_in_brackets(pending.target, known));
  return false;
}

/// Of several transitions of one state, a later one that an earlier one always forestalls.
void TransitionReader::check_fights() {
  for (std::size_t later = 0; later < pending_.size(); ++later) {
    const Pending& mine = pending_[later];
    const auto forestalls = [&](const Pending& other) {
      const Transition& a = other.transition;
      const Transition& b = mine.transition;
      if (a.source != b.source || a.cause != b.cause || a.trigger != b.trigger) return false;
      if (a.cause == MachineTransition::Cause::kCondition || a.after > b.after) return false;
      return a.guard.call == nullptr || (other.guard != nullptr && other.guard == mine.guard);
    };
    const auto end = pending_.begin() + static_cast<std::ptrdiff_t>(later);
    if (std::any_of(pending_.begin(), end, forestalls)) {
      reader_.complain(mine.place, "it is never taken: the one before it always is");
    }
  }
}

}  // namespace armature::lua::internal
