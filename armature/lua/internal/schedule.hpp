// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <lua5.4/lua.hpp>

#include "armature/base/diagnostic.hpp"
#include "armature/base/time.hpp"
#include "armature/component/operations/command.hpp"
#include "armature/exec/application.hpp"
#include "armature/lua/internal/events.hpp"
#include "armature/lua/internal/sandbox.hpp"
#include "armature/lua/internal/sources.hpp"

namespace armature::lua::internal {

/// Of any time that a script names; more is a mistake, and would overflow the nanoseconds.
inline constexpr double kLongestSeconds = 1e9;

class Machine;
class Machines;

/// What of a script runs when: its main part and the functions of `at`, `on` and `run`, each a
/// coroutine that goes on when what it waits for is there. At one instant events come first, then
/// state machines, then parts, of which the one that was made first comes first.
class Schedule {
 public:
  Schedule(Sandbox& sandbox, const Sources& sources, exec::Application& application);
  Schedule(const Schedule&) = delete;
  Schedule& operator=(const Schedule&) = delete;
  ~Schedule();

  /// Gives Lua `at`, `wait`, `now`, `stop`, `on` and `machine`.
  void install(lua_State* lua);

  /// Told of the end of a part, with its mistake if it made one; true if that is dealt with.
  using AtEnd = std::function<bool(lua_State*, const std::string* mistake)>;
  /// Takes a function and its arguments from the stack of `lua`: a part that is due now, known by
  /// its thread.
  lua_State* add(lua_State* lua, int arguments = 0, AtEnd at_end = {}) {
    return add(lua, application_.now(), arguments, std::move(at_end));
  }
  /// Ends a part, which may be the one that runs: that at its next wait.
  void end(const lua_State* part);
  /// Not yet at its end.
  bool has(const lua_State* part) const { return find(part) != nullptr; }
  /// Whether that part waits for a command to end.
  bool awaits_command(const lua_State* part) const;
  void drop(const lua_State* part);
  bool empty() const { return parts_.empty(); }

  enum class Turn { kDone, kStopped, kMistaken };
  /// Lets everything run whose time has come, until a part stops the script or makes a mistake,
  /// which is its end.
  Turn run_what_is_due(base::Diagnostics& diagnostics);
  /// When something is due that only waits for its time; the end of time if nothing does.
  base::Time next_due() const;
  /// Whether something waits for more than its time.
  bool waits_for_news() const;
  /// True if a command ended that something waits for, or an event came.
  bool news_came() const;
  /// Leaves all states of all machines.
  void stop_machines(base::Diagnostics& diagnostics);

  Events& events() { return events_; }
  const Machines& machines() const { return *machines_; }
  /// The script's time.
  base::Time instant() const { return instant_; }
  bool stopped() const { return stopped_; }

 private:
  struct Part {
    lua_State* thread;  ///< kept by the registry
    base::Time due;
    component::CommandHandle* command = nullptr;  ///< waits for it rather than for its time
    const Machine* machine = nullptr;             ///< likewise
    Events::Id event = Events::kNobody;           ///< waits for it, and for its time at most
    int given = 0;                                ///< values on its stack that it goes on with
    bool ended = false;
    AtEnd at_end{};
  };

  static Schedule& of(lua_State* lua);
  static int at(lua_State* lua);
  static int wait(lua_State* lua);
  static int wait_for_event(lua_State* lua);
  static int after_wait(lua_State* lua, int status, lua_KContext);
  static int now(lua_State* lua);
  static int stop(lua_State* lua);

  lua_State* add(lua_State* lua, base::Time due, int arguments, AtEnd at_end);
  const Part* find(const lua_State* thread) const;
  bool is_due(const Part& part) const;
  std::size_t next_part() const;
  bool has_work() const;
  void tell(const lua_State* part, lua_State* lua, const Events::Arguments& arguments);
  Turn turn(base::Diagnostics& diagnostics);
  Turn resume(std::size_t index, base::Diagnostics& diagnostics);
  Turn end_part(lua_State* thread, bool mistaken, base::Diagnostics& diagnostics);
  bool run_protected(const std::function<void(lua_State*)>& code, base::Diagnostics& diagnostics);
  void remove_ended();
  bool stands_still(base::Diagnostics& diagnostics);
  base::Diagnostic mistake_of(lua_State* thread);

  Sandbox& sandbox_;
  const Sources& sources_;
  exec::Application& application_;
  base::Time begin_;
  base::Time instant_;  ///< at which all that is due runs: the script's time
  std::uint64_t resumed_at_instant_ = 0;
  std::vector<Part> parts_;       ///< in the order in which they were made
  std::size_t running_ = 0;       ///< of parts_
  lua_State* current_ = nullptr;  ///< the part that runs
  bool stopped_ = false;
  Events events_;
  std::unique_ptr<Machines> machines_;
};

}  // namespace armature::lua::internal
