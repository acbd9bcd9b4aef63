// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <lua5.4/lua.hpp>

#include "armature/base/diagnostic.hpp"
#include "armature/base/time.hpp"
#include "armature/component/command.hpp"
#include "armature/exec/application.hpp"
#include "armature/script/internal/sandbox.hpp"
#include "armature/script/internal/sources.hpp"

namespace armature::script::internal {

/// What of a script runs when: its main part and the functions of `at`, each a coroutine that goes
/// on when what it waits for is there. At one instant the one that was made first comes first.
class Schedule {
 public:
  Schedule(Sandbox& sandbox, const Sources& sources, exec::Application& application);
  Schedule(const Schedule&) = delete;
  Schedule& operator=(const Schedule&) = delete;

  /// Gives the script `at`, `wait`, `now` and `stop`, and takes its main part from the stack.
  void install(lua_State* lua);

  /// Lets everything run whose time has come; false if the script stopped or made a mistake.
  bool run_what_is_due(base::Diagnostics& diagnostics);
  /// When something is due that only waits for its time; the end of time if nothing does.
  base::Time next_due() const;
  bool waits_for_commands() const;
  /// True if a command ended that something waits for.
  bool command_ended() const;

 private:
  struct Part {
    lua_State* thread;  ///< kept by the registry
    base::Time due;
    component::CommandHandle* command = nullptr;  ///< waits for it rather than for its time
  };

  static Schedule& of(lua_State* lua);
  static int at(lua_State* lua);
  static int wait(lua_State* lua);
  static int after_wait(lua_State* lua, int status, lua_KContext);
  static int now(lua_State* lua);
  static int stop(lua_State* lua);

  /// Takes a function from the stack of `lua`.
  void add(lua_State* lua, base::Time due);
  bool is_due(const Part& part) const;
  bool resume(std::size_t index, base::Diagnostics& diagnostics);
  bool stands_still(base::Diagnostics& diagnostics);
  base::Diagnostic mistake_of(lua_State* thread);

  Sandbox& sandbox_;
  const Sources& sources_;
  exec::Application& application_;
  base::Time begin_;
  base::Time instant_;  ///< at which all that is due runs: the script's time
  std::uint64_t resumed_at_instant_ = 0;
  std::vector<Part> parts_;  ///< in the order in which they were made
  std::size_t running_ = 0;  ///< of parts_
  bool stopped_ = false;
};

}  // namespace armature::script::internal
