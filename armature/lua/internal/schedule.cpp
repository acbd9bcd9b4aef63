// SPDX-License-Identifier: Apache-2.0
#include "armature/lua/internal/schedule.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "armature/base/seconds.hpp"
#include "armature/lua/internal/components.hpp"
#include "armature/lua/internal/machines.hpp"
#include "armature/lua/internal/subscriptions.hpp"
#include "armature/lua/internal/values.hpp"

namespace armature::lua::internal {
namespace {

/// So many turns at one instant are a script that calls itself by `at` without end.
constexpr std::uint64_t kTurnsAtOneInstant = 100'000;

base::Duration duration_at(lua_State* lua, int index, const char* function, const char* wanted) {
  const bool number = lua_type(lua, index) == LUA_TNUMBER;
  const double seconds = number ? lua_tonumber(lua, index) : std::nan("");
  if (!(seconds >= 0.0 && seconds <= kLongestSeconds)) {
    refuse(lua, std::string(function) + " takes " + wanted + ", found " +
                    (lua_isnoneornil(lua, index) ? "nothing" : text_at(lua, index)));
  }
  return base::from_seconds(seconds);
}

}  // namespace

Schedule::Schedule(Sandbox& sandbox, const Sources& sources, exec::Application& application)
    : sandbox_(sandbox),
      sources_(sources),
      application_(application),
      begin_(application.now()),
      instant_(begin_),
      events_(application),
      machines_(std::make_unique<Machines>(*this)) {}

Schedule::~Schedule() = default;

Schedule& Schedule::of(lua_State* lua) {
  return *static_cast<Schedule*>(lua_touserdata(lua, lua_upvalueindex(1)));
}

void Schedule::install(lua_State* lua) {
  const auto give = [&](const char* name, lua_CFunction function) {
    lua_pushlightuserdata(lua, this);
    lua_pushcclosure(lua, function, 1);
    lua_setglobal(lua, name);
  };
  give("at", &Schedule::at);
  give("wait", &Schedule::wait);
  give("now", &Schedule::now);
  give("stop", &Schedule::stop);
  install_subscriptions(lua, *this);
  machines_->install(lua);
}

// --- parts ---------------------------------------------------------------------------------------

lua_State* Schedule::add(lua_State* lua, base::Time due, int arguments, AtEnd at_end) {
  luaL_checkstack(lua, 2, "parts");
  lua_State* const thread = lua_newthread(lua);
  lua_rawsetp(lua, LUA_REGISTRYINDEX, thread);
  luaL_checkstack(thread, arguments + 1, "parts");
  lua_xmove(lua, thread, arguments + 1);
  Part part{thread, due};
  part.given = arguments;
  part.at_end = std::move(at_end);
  parts_.push_back(std::move(part));
  return thread;
}

const Schedule::Part* Schedule::find(const lua_State* thread) const {
  const auto found = std::find_if(parts_.begin(), parts_.end(),
                                  [&](const Part& part) { return part.thread == thread; });
  return found == parts_.end() ? nullptr : &*found;
}

bool Schedule::awaits_command(const lua_State* part) const {
  const Part* const found = find(part);
  return found != nullptr && found->command != nullptr;
}

void Schedule::end(const lua_State* part) {
  for (Part& one : parts_) {
    if (one.thread == part) one.ended = true;
  }
}

void Schedule::remove_ended() {
  for (std::size_t i = 0; i < parts_.size();) {
    if (parts_[i].ended) {
      drop(parts_[i].thread);
    } else {
      ++i;
    }
  }
}

void Schedule::drop(const lua_State* part) {
  const Part* const found = find(part);
  if (found == nullptr) return;
  events_.forget(found->event);
  lua_pushnil(sandbox_.lua());
  lua_rawsetp(sandbox_.lua(), LUA_REGISTRYINDEX, part);
  parts_.erase(parts_.begin() + (found - parts_.data()));
}

// --- what Lua calls ------------------------------------------------------------------------------

int Schedule::at(lua_State* lua) {
  Schedule& schedule = of(lua);
  const base::Duration time = duration_at(lua, 1, "at", "a number of seconds from 0 on");
  if (lua_type(lua, 2) != LUA_TFUNCTION || lua_gettop(lua) != 2) {
    refuse(lua, "at takes a time and a function: at(5.0, function() ... end)");
  }
  const base::Time due = base::later(schedule.begin_, time);
  if (due < schedule.instant_) {
    refuse(lua, "at(" + text_at(lua, 1) +
                    ") is too late: " + seconds_text(schedule.instant_ - schedule.begin_) +
                    " have passed since the script began");
  }
  schedule.add(lua, due, 0, {});
  return 0;
}

int Schedule::wait(lua_State* lua) {
  constexpr const char* kWanted = "a number of seconds above 0, a command, an event or a machine";
  Schedule& schedule = of(lua);
  component::CommandHandle* const command = command_at(lua, 1);
  const Machine* const machine = machine_at(lua, 1);
  const bool for_event = event_at(lua, 1) != nullptr;
  const bool for_time = command == nullptr && machine == nullptr && !for_event;
  const base::Duration time = for_time ? duration_at(lua, 1, "wait", kWanted) : base::Duration{};
  if (for_time && time == base::Duration::zero()) {
    refuse(lua, std::string("wait takes ") + kWanted + ", found " + text_at(lua, 1));
  }
  if (lua != schedule.current_) {
    refuse(lua, "an action of a machine cannot wait: put what takes time into its `run`");
  }
  const bool over =
      (command != nullptr && command->ended()) || (machine != nullptr && !machine->running());
  if (over) return after_wait(lua, LUA_OK, 0);
  if (lua_isyieldable(lua) == 0) refuse(lua, "a function that Lua itself calls cannot wait");
  if (for_event) return wait_for_event(lua);
  lua_settop(lua, 1);  // stays there, so that the command is kept
  Part& part = schedule.parts_[schedule.running_];
  part.command = command;
  part.machine = machine;
  part.due = base::later(schedule.instant_, time);
  return lua_yieldk(lua, 0, 0, &Schedule::after_wait);
}

int Schedule::wait_for_event(lua_State* lua) {
  Schedule& schedule = of(lua);
  const base::Duration limit =
      lua_isnoneornil(lua, 2) ? base::Duration::max()
                              : duration_at(lua, 2, "wait(event, limit)", "a number of seconds");
  const Events::Id id = listen(lua, schedule.events_, *event_at(lua, 1),
                               [&schedule, lua](lua_State* to, const Events::Arguments& arguments) {
                                 schedule.tell(lua, to, arguments);
                               });
  lua_settop(lua, 1);
  Part& part = schedule.parts_[schedule.running_];
  part.event = id;
  part.due = base::later(schedule.instant_, limit);
  return lua_yieldk(lua, 0, 0, &Schedule::after_wait);
}

/// `part` goes on with true and what came with the event.
void Schedule::tell(const lua_State* part, lua_State* lua, const Events::Arguments& arguments) {
  Part* const waiting = const_cast<Part*>(find(part));
  if (waiting == nullptr) return;
  events_.forget(std::exchange(waiting->event, Events::kNobody));
  luaL_checkstack(lua, 1, "arguments");
  lua_pushboolean(lua, 1);
  waiting->given = 1 + push_arguments(lua, arguments);
  luaL_checkstack(waiting->thread, waiting->given, "arguments");
  lua_xmove(lua, waiting->thread, waiting->given);
  waiting->due = instant_;
}

int Schedule::after_wait(lua_State* lua, int, lua_KContext) {
  if (event_at(lua, 1) != nullptr) {
    if (lua_gettop(lua) > 1) return lua_gettop(lua) - 1;
    lua_pushboolean(lua, 0);
    lua_pushliteral(lua, "the time is up");
    return 2;
  }
  const component::CommandHandle* const command = command_at(lua, 1);
  const Machine* const machine = machine_at(lua, 1);
  if (command == nullptr && machine == nullptr) return 0;
  const bool done =
      command != nullptr ? command->stage() == component::CommandStage::kDone : machine->at_end();
  lua_pushboolean(lua, done);
  if (done) return 1;
  const std::string reason = command != nullptr ? reason_of(*command) : "the machine was stopped";
  lua_pushlstring(lua, reason.data(), reason.size());
  return 2;
}

int Schedule::now(lua_State* lua) {
  const Schedule& schedule = of(lua);
  lua_pushnumber(lua, base::to_seconds(schedule.instant_ - schedule.begin_));
  return 1;
}

int Schedule::stop(lua_State* lua) {
  if (lua_isyieldable(lua) == 0) refuse(lua, "a function that Lua itself calls cannot stop");
  of(lua).stopped_ = true;
  return lua_yield(lua, 0);
}

// --- turns ---------------------------------------------------------------------------------------

bool Schedule::is_due(const Part& part) const {
  if (part.command != nullptr) return part.command->ended();
  if (part.machine != nullptr) return !part.machine->running();
  return part.due <= instant_;
}

/// What Lua does here may meet its memory limit.
base::Diagnostic Schedule::mistake_of(lua_State* thread) {
  std::string text;
  const base::Result<void> read = sandbox_.run_protected([&](lua_State* lua) {
    lua_xmove(thread, lua, 1);
    text = text_at(lua, -1);
  });
  return sources_.diagnostic(thread, read ? text : read.error());
}

bool Schedule::run_protected(const std::function<void(lua_State*)>& code,
                             base::Diagnostics& diagnostics) {
  sandbox_.restart_clock();
  const base::Result<void> run = sandbox_.run_protected(code);
  const auto mistake = machines_->take_mistake();
  if (!run) diagnostics.add(sources_.diagnostic(sandbox_.lua(), run.error()));
  if (mistake) diagnostics.add(sources_.diagnostic(sandbox_.lua(), *mistake));
  return run.ok() && !mistake;
}

Schedule::Turn Schedule::resume(std::size_t index, base::Diagnostics& diagnostics) {
  running_ = index;
  Part& part = parts_[index];
  part.command = nullptr;
  part.machine = nullptr;
  events_.forget(std::exchange(part.event, Events::kNobody));
  lua_State* const thread = part.thread;
  sandbox_.restart_clock();
  current_ = thread;
  int left = 0;
  const int status = lua_resume(thread, sandbox_.lua(), std::exchange(part.given, 0), &left);
  current_ = nullptr;
  return status == LUA_YIELD ? Turn::kDone : end_part(thread, status != LUA_OK, diagnostics);
}

Schedule::Turn Schedule::end_part(lua_State* thread, bool mistaken,
                                  base::Diagnostics& diagnostics) {
  const Part* const part = find(thread);
  const AtEnd at_end = part->ended ? AtEnd{} : part->at_end;
  base::Diagnostic mistake;
  if (mistaken) mistake = mistake_of(thread);
  drop(thread);
  bool dealt_with = !mistaken;
  bool good = true;
  if (at_end) {
    good = run_protected(
        [&](lua_State* lua) { dealt_with = at_end(lua, mistaken ? &mistake.message : nullptr); },
        diagnostics);
  }
  if (!dealt_with && good) diagnostics.add(mistake);
  return dealt_with && good ? Turn::kDone : Turn::kMistaken;
}

bool Schedule::stands_still(base::Diagnostics& diagnostics) {
  if (++resumed_at_instant_ <= kTurnsAtOneInstant) return false;
  resumed_at_instant_ = 0;
  diagnostics.error({sources_.path(), 0, 0},
                    "`at`, events or machines call each other without end at one instant: let time "
                    "pass between them");
  return true;
}

/// The number of parts if none is due.
std::size_t Schedule::next_part() const {
  std::size_t next = parts_.size();
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    if (!is_due(parts_[i])) continue;
    if (next == parts_.size() || parts_[i].due < parts_[next].due) next = i;
  }
  return next;
}

bool Schedule::has_work() const {
  return events_.any_arrived() || machines_->next_due() <= instant_ || next_part() < parts_.size();
}

Schedule::Turn Schedule::turn(base::Diagnostics& diagnostics) {
  bool done = false;
  const auto work = [&](lua_State* lua) {
    done = events_.deliver_next(lua) || machines_->step_next(lua, instant_);
  };
  if (!run_protected(work, diagnostics)) return Turn::kMistaken;
  const std::size_t next = next_part();
  return done || next == parts_.size() ? Turn::kDone : resume(next, diagnostics);
}

Schedule::Turn Schedule::run_what_is_due(base::Diagnostics& diagnostics) {
  const base::Time now = application_.now();
  if (std::exchange(instant_, now) != now) resumed_at_instant_ = 0;
  while (true) {
    remove_ended();
    if (stopped_) return Turn::kStopped;
    if (!has_work()) return Turn::kDone;
    if (stands_still(diagnostics)) {
      if (next_part() < parts_.size()) drop(parts_[next_part()].thread);
      return Turn::kMistaken;
    }
    if (turn(diagnostics) != Turn::kDone) return Turn::kMistaken;
  }
}

base::Time Schedule::next_due() const {
  base::Time earliest = machines_->next_due();
  for (const Part& part : parts_) {
    const bool for_time = part.command == nullptr && part.machine == nullptr;
    if (for_time) earliest = std::min(earliest, part.due);
  }
  return earliest;
}

bool Schedule::waits_for_news() const {
  return events_.any_listens() || std::any_of(parts_.begin(), parts_.end(), [](const Part& part) {
           return part.command != nullptr;
         });
}

bool Schedule::news_came() const {
  return events_.any_arrived() || std::any_of(parts_.begin(), parts_.end(), [](const Part& part) {
           return part.command != nullptr && part.command->ended();
         });
}

void Schedule::stop_machines(base::Diagnostics& diagnostics) {
  run_protected([&](lua_State* lua) { machines_->stop_all(lua); }, diagnostics);
}

}  // namespace armature::lua::internal
