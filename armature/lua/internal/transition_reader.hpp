// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <lua5.4/lua.hpp>

#include "armature/lua/internal/machine_definition.hpp"
#include "armature/lua/internal/table_reader.hpp"

namespace armature::lua::internal {

/// Reads what leads from the states of a machine to others: `on`, `failed`, `done`, `after`,
/// `when`.
class TransitionReader {
 public:
  TransitionReader(lua_State* lua, MachineDefinition& definition)
      : lua_(lua), definition_(definition), reader_(lua, definition.problems) {}

  void read(int table, int state, const std::string& place);

  /// Looks up the targets once all states are known, and checks what there is.
  void finish();

 private:
  using Transition = component::MachineTransition;
  struct Pending {
    Transition transition;
    std::string target;
    std::string place;
    const void* guard = nullptr;  ///< tells functions of Lua apart
  };
  /// What those that are being read have in common.
  struct Cause {
    int state;
    Transition::Cause kind;
    std::size_t trigger;
  };

  std::size_t trigger(const std::string& name, MachineDefinition::Trigger how);
  void read_on(int table, int state, const std::string& place);
  void read_reaction(int table, const char* key, const std::string& place, const Cause& cause);
  void read_alternatives(const std::string& place, const Cause& cause);
  void read_one(const std::string& place, const Cause& cause);
  void read_table(int table, Pending& pending);
  bool read_first(int table, Pending& pending);
  void read_target(int table, int position, Pending& pending);
  MachineFunction* keep(int reference, const Transition& transition);
  bool resolve(Pending& pending);
  void check_fights();

  lua_State* lua_;
  MachineDefinition& definition_;
  TableReader reader_;
  std::vector<Pending> pending_;
};

}  // namespace armature::lua::internal
