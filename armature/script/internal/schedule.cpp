// SPDX-License-Identifier: Apache-2.0
#include "armature/script/internal/schedule.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "armature/script/internal/components.hpp"
#include "armature/script/internal/values.hpp"

namespace armature::script::internal {
namespace {

/// More is a mistake, and would be no number of nanoseconds any more.
constexpr double kLongestSeconds = 1e9;

/// So many turns at one instant are a script that calls itself by `at` without end.
constexpr std::uint64_t kTurnsAtOneInstant = 100'000;

base::Duration duration_at(lua_State* lua, const char* function, const char* wanted) {
  const double seconds = lua_type(lua, 1) == LUA_TNUMBER ? lua_tonumber(lua, 1) : std::nan("");
  if (!(seconds >= 0.0 && seconds <= kLongestSeconds)) {
    refuse(lua, std::string(function) + " takes " + wanted + ", found " +
                    (lua_isnoneornil(lua, 1) ? "nothing" : text_at(lua, 1)));
  }
  return base::Duration(std::llround(seconds * 1e9));
}

}  // namespace

Schedule::Schedule(Sandbox& sandbox, const Sources& sources, exec::Application& application)
    : sandbox_(sandbox),
      sources_(sources),
      application_(application),
      begin_(application.now()),
      instant_(begin_) {}

Schedule& Schedule::of(lua_State* lua) {
  return *static_cast<Schedule*>(lua_touserdata(lua, lua_upvalueindex(1)));
}

void Schedule::install(lua_State* lua) {
  add(lua, begin_);
  const auto give = [&](const char* name, lua_CFunction function) {
    lua_pushlightuserdata(lua, this);
    lua_pushcclosure(lua, function, 1);
    lua_setglobal(lua, name);
  };
  give("at", &Schedule::at);
  give("wait", &Schedule::wait);
  give("now", &Schedule::now);
  give("stop", &Schedule::stop);
}

void Schedule::add(lua_State* lua, base::Time due) {
  lua_State* const thread = lua_newthread(lua);
  lua_rawsetp(lua, LUA_REGISTRYINDEX, thread);
  lua_xmove(lua, thread, 1);
  parts_.push_back({thread, due});
}

int Schedule::at(lua_State* lua) {
  Schedule& schedule = of(lua);
  const base::Duration time = duration_at(lua, "at", "a number of seconds from 0 on");
  if (lua_type(lua, 2) != LUA_TFUNCTION || lua_gettop(lua) != 2) {
    refuse(lua, "at takes a time and a function: at(5.0, function() ... end)");
  }
  const base::Time due = base::later(schedule.begin_, time);
  if (due < schedule.instant_) {
    refuse(lua, "at(" + text_at(lua, 1) +
                    ") is too late: " + seconds_text(schedule.instant_ - schedule.begin_) +
                    " have passed since the script began");
  }
  schedule.add(lua, due);
  return 0;
}

int Schedule::wait(lua_State* lua) {
  constexpr const char* kWanted = "a number of seconds above 0, or a command";
  Schedule& schedule = of(lua);
  component::CommandHandle* const command = command_at(lua, 1);
  const base::Duration time =
      command == nullptr ? duration_at(lua, "wait", kWanted) : base::Duration{};
  if (command == nullptr && time == base::Duration::zero()) {
    refuse(lua, std::string("wait takes ") + kWanted + ", found " + text_at(lua, 1));
  }
  if (command != nullptr && command->ended()) return after_wait(lua, LUA_OK, 0);
  if (lua_isyieldable(lua) == 0) refuse(lua, "a function that Lua itself calls cannot wait");
  lua_settop(lua, 1);  // stays there, so that the command is kept
  Part& part = schedule.parts_[schedule.running_];
  part.command = command;
  part.due = base::later(schedule.instant_, time);
  return lua_yieldk(lua, 0, 0, &Schedule::after_wait);
}

int Schedule::after_wait(lua_State* lua, int, lua_KContext) {
  const component::CommandHandle* const command = command_at(lua, 1);
  if (command == nullptr) return 0;
  const bool done = command->stage() == component::CommandStage::kDone;
  lua_pushboolean(lua, done);
  if (done) return 1;
  const std::string reason = reason_of(*command);
  lua_pushlstring(lua, reason.data(), reason.size());
  return 2;
}

int Schedule::now(lua_State* lua) {
  const Schedule& schedule = of(lua);
  lua_pushnumber(lua, std::chrono::duration<double>(schedule.instant_ - schedule.begin_).count());
  return 1;
}

int Schedule::stop(lua_State* lua) {
  if (lua_isyieldable(lua) == 0) refuse(lua, "a function that Lua itself calls cannot stop");
  of(lua).stopped_ = true;
  return lua_yield(lua, 0);
}

bool Schedule::is_due(const Part& part) const {
  return part.command != nullptr ? part.command->ended() : part.due <= instant_;
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

bool Schedule::resume(std::size_t index, base::Diagnostics& diagnostics) {
  running_ = index;
  parts_[index].command = nullptr;
  lua_State* const thread = parts_[index].thread;
  sandbox_.restart_clock();
  int left = 0;
  const int status = lua_resume(thread, sandbox_.lua(), 0, &left);
  if (status == LUA_YIELD) return !stopped_;
  if (status != LUA_OK) {
    diagnostics.add(mistake_of(thread));
    return false;
  }
  lua_pushnil(sandbox_.lua());
  lua_rawsetp(sandbox_.lua(), LUA_REGISTRYINDEX, thread);
  parts_.erase(parts_.begin() + static_cast<std::ptrdiff_t>(index));
  return true;
}

bool Schedule::stands_still(base::Diagnostics& diagnostics) {
  if (++resumed_at_instant_ <= kTurnsAtOneInstant) return false;
  diagnostics.error({sources_.path(), 0, 0},
                    "the script goes on by `at` without end, while its time stands still");
  return true;
}

bool Schedule::run_what_is_due(base::Diagnostics& diagnostics) {
  const base::Time now = application_.now();
  if (std::exchange(instant_, now) != now) resumed_at_instant_ = 0;
  while (true) {
    std::size_t next = parts_.size();
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      if (!is_due(parts_[i])) continue;
      if (next == parts_.size() || parts_[i].due < parts_[next].due) next = i;
    }
    if (next == parts_.size()) return true;
    if (stands_still(diagnostics) || !resume(next, diagnostics)) return false;
  }
}

base::Time Schedule::next_due() const {
  base::Time earliest = base::Time::max();
  for (const Part& part : parts_) {
    if (part.command == nullptr) earliest = std::min(earliest, part.due);
  }
  return earliest;
}

bool Schedule::waits_for_commands() const {
  return std::any_of(parts_.begin(), parts_.end(),
                     [](const Part& part) { return part.command != nullptr; });
}

bool Schedule::command_ended() const {
  return std::any_of(parts_.begin(), parts_.end(), [](const Part& part) {
    return part.command != nullptr && part.command->ended();
  });
}

}  // namespace armature::script::internal
