// SPDX-License-Identifier: Apache-2.0
#include "armature/lua/internal/machine_definition.hpp"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <utility>

#include "armature/base/near_name.hpp"
#include "armature/base/seconds.hpp"
#include "armature/lua/internal/schedule.hpp"
#include "armature/lua/internal/table_reader.hpp"
#include "armature/lua/internal/transition_reader.hpp"

namespace armature::lua::internal {
namespace {

using component::kNoState;
using component::MachineState;
using Names = std::vector<std::string>;

constexpr int kDeepestStates = 32;
constexpr std::size_t kMostStates = 1000;
constexpr int kStackForState = 24;
constexpr double kShortestPeriod = 0.001;

const Names kMachineKeys = {"doc", "initial", "name", "period"};
const Names kStateKeys = {"after",  "doc",   "done",    "during", "entry", "exit",
                          "failed", "final", "initial", "on",     "run",   "when"};

bool names_state(const std::string& key) {
  return std::isupper(static_cast<unsigned char>(key.front())) != 0;
}

class MachineReader {
 public:
  MachineReader(lua_State* lua, MachineDefinition& definition)
      : lua_(lua),
        definition_(definition),
        reader_(lua, definition.problems),
        transitions_(lua, definition) {}

  void read(int table);

 private:
  MachineState& state_at(int state) {
    return definition_.table.states[static_cast<std::size_t>(state)];
  }
  void read_period(int table);
  Names states_in(int table, const std::string& place, const Names& known);
  void put_initial_first(int table, const std::string& place, Names& states);
  void read_substates(int table, int parent, const std::string& place, const Names& known);
  void read_state(int table, int self);
  void read_actions(int table, int self, const std::string& place);
  void* keep(MachineFunction::Kind kind, int reference, int state) {
    return &definition_.functions.emplace_back(
        MachineFunction{kind, reference, state, kNoTrigger, nullptr});
  }

  lua_State* lua_;
  MachineDefinition& definition_;
  TableReader reader_;
  TransitionReader transitions_;
  int depth_ = 0;
};

void MachineReader::read(int table) {
  const std::string name = reader_.text(table, "name", "");
  if (!name.empty()) definition_.name = name;
  reader_.text(table, "doc", "");
  read_period(table);
  read_substates(table, kNoState, "", kMachineKeys);
  transitions_.finish();
}

void MachineReader::read_period(int table) {
  if (reader_.get(table, "period")) {
    const double seconds = reader_.is(LUA_TNUMBER) ? lua_tonumber(lua_, -1) : 0.0;
    if (seconds >= kShortestPeriod && seconds <= kLongestSeconds) {
      definition_.period = base::from_seconds(seconds);
    } else {
      reader_.complain("",
                       "period must be a number of seconds from 0.001 on, found " + reader_.top());
    }
  }
  lua_pop(lua_, 1);
}

Names MachineReader::states_in(int table, const std::string& place, const Names& known) {
  Names states;
  for (const std::string& key : reader_.keys(table, place)) {
    if (key.empty()) {
      reader_.complain(place, "a name is empty");
    } else if (names_state(key)) {
      states.push_back(key);
    } else if (std::find(known.begin(), known.end(), key) == known.end()) {
      reader_.complain_of_key(place, key, known, "; names of states begin with a capital letter");
    }
  }
  return states;
}

/// So tables of machines have it.
void MachineReader::put_initial_first(int table, const std::string& place, Names& states) {
  const std::string initial = reader_.text(table, "initial", place);
  const auto first = std::find(states.begin(), states.end(), initial);
  if (first != states.end()) {
    std::rotate(states.begin(), first, first + 1);
  } else if (!initial.empty()) {
    reader_.complain(place, "initial: unknown state '" + initial + "'" +
                                base::suggestion_in_brackets(initial, states));
    definition_.knows_all_ways = false;
  } else if (states.size() > 1) {
    reader_.complain(place, "initial is missing: which of its states comes first, " + states[0] +
                                ", " + states[1] + "?");
    definition_.knows_all_ways = false;
  }
}

void MachineReader::read_substates(int table, int parent, const std::string& place,
                                   const Names& known) {
  Names states = states_in(table, place, known);
  put_initial_first(table, place, states);
  for (const std::string& name : states) {
    const bool too_many =
        depth_ >= kDeepestStates || definition_.table.states.size() >= kMostStates;
    lua_pushlstring(lua_, name.data(), name.size());
    lua_rawget(lua_, table);
    if (!reader_.is(LUA_TTABLE)) {
      reader_.complain(place, "state '" + name + "' must be a table, found " + reader_.top());
    } else if (too_many) {
      reader_.complain(place,
                       "state '" + name +
                           "' is one too many: a machine has at most 1000, nested at most 32 deep");
    } else {
      const int self = static_cast<int>(definition_.table.states.size());
      definition_.table.states.emplace_back();
      definition_.states.emplace_back();
      state_at(self).name = name;
      state_at(self).parent = parent;
      read_state(lua_gettop(lua_), self);
    }
    lua_pop(lua_, 1);
  }
}

void MachineReader::read_state(int table, int self) {
  luaL_checkstack(lua_, kStackForState, "states");
  const std::string place = "state '" + definition_.table.path(self) + "'";
  state_at(self).doc = reader_.text(table, "doc", place);
  if (reader_.get(table, "final")) {
    if (!reader_.is(LUA_TBOOLEAN)) {
      reader_.complain(place, "final must be true, found " + reader_.top());
    }
    state_at(self).final = lua_toboolean(lua_, -1) != 0;
  }
  lua_pop(lua_, 1);
  read_actions(table, self, place);
  transitions_.read(table, self, place);
  ++depth_;
  read_substates(table, self, place, kStateKeys);
  --depth_;
  const bool composite = static_cast<int>(definition_.table.states.size()) > self + 1;
  const bool runs = definition_.states[static_cast<std::size_t>(self)].run != LUA_NOREF;
  if (runs && composite) reader_.complain(place, "only a state without substates may have run");
  if (runs && state_at(self).final) reader_.complain(place, "a final state has no run");
}

/// Whoever enters or leaves a state is always told: times begin, and its run.
void MachineReader::read_actions(int table, int self, const std::string& place) {
  const int entry = reader_.function(table, "entry", place);
  const int exit = reader_.function(table, "exit", place);
  const int during = reader_.function(table, "during", place);
  definition_.states[static_cast<std::size_t>(self)].run = reader_.function(table, "run", place);
  MachineState& state = state_at(self);
  state.entry = {&MachineFunction::perform, keep(MachineFunction::Kind::kEntry, entry, self), {}};
  state.exit = {&MachineFunction::perform, keep(MachineFunction::Kind::kExit, exit, self), {}};
  if (during == LUA_NOREF) return;
  state.during = {
      &MachineFunction::perform, keep(MachineFunction::Kind::kDuring, during, self), {}};
}

}  // namespace

MachineDefinition read_machine(lua_State* lua, int index) {
  MachineDefinition definition;
  luaL_checkstack(lua, kStackForState, "machine");
  MachineReader(lua, definition).read(lua_absindex(lua, index));
  return definition;
}

}  // namespace armature::lua::internal
