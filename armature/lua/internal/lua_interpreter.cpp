// SPDX-License-Identifier: Apache-2.0
#include "armature/lua/internal/lua_interpreter.hpp"

#include <algorithm>
#include <utility>

#include "armature/inspect/acts.hpp"
#include "armature/lua/internal/machines.hpp"
#include "armature/lua/internal/standard.hpp"
#include "armature/lua/internal/values.hpp"
#include "armature/platform/clock.hpp"

namespace armature::lua::internal {
namespace {

using component::CommandHandle;
using namespace std::chrono_literals;

constexpr const char* kName = "prompt";
constexpr const char* kInterrupted = "interrupted";
constexpr const char* kShowing = "armature showing";
constexpr std::size_t kMemoryLimit = 64u << 20;
constexpr base::Duration kLookPeriod = 20ms;
constexpr base::Duration kProgressPeriod = 100ms;

/// Gives a chunk's results to `show`; in Lua, so that the chunk may wait.
constexpr std::string_view kShow = R"(
local show = ...
return function(chunk) return function() show(chunk()) end end
)";

}  // namespace

LuaInterpreter::LuaInterpreter(exec::Application& application, Course& course, Listener& listener,
                               const InterpreterOptions& options)
    : application_(application),
      course_(course),
      listener_(listener),
      options_(options),
      access_{application, exec::Caller::kOperator,
              [this](lua_State* lua, const std::string& name) { note_begun(lua, name); }},
      print_([this](std::string_view line) { listener_.say(line); }),
      sources_(kName),
      sandbox_(kMemoryLimit, base::Duration::max()),
      schedule_(sandbox_, sources_, application) {
  sources_.name_of(kName);
  sandbox_.end_when([this] { return reason_to_end(); });
  const base::Result<void> ready = sandbox_.run_protected([&](lua_State* lua) {
    install_standard(lua, print_, sources_);
    schedule_.install(lua);
    install_components(lua, access_);
    if (!compile(lua, kShow, "show")) lua_error(lua);
    lua_pushlightuserdata(lua, this);
    lua_pushcclosure(lua, &LuaInterpreter::show_results, 1);
    lua_call(lua, 1, 1);
    lua_setfield(lua, LUA_REGISTRYINDEX, kShowing);
  });
  if (!ready) listener_.complain(ready.error());
}

LuaInterpreter::~LuaInterpreter() {
  base::Diagnostics mistakes;
  schedule_.stop_machines(mistakes);
  for (const base::Diagnostic& mistake : mistakes.all()) tell(mistake);
}

std::vector<MachineStatus> LuaInterpreter::machines() const {
  std::vector<MachineStatus> all;
  for (const auto& machine : schedule_.machines().all()) {
    all.push_back({machine->name(), std::string(machine->state())});
  }
  return all;
}

// --- what Lua gives ------------------------------------------------------------------------------

int LuaInterpreter::show_results(lua_State* lua) {
  auto& self = *static_cast<LuaInterpreter*>(lua_touserdata(lua, lua_upvalueindex(1)));
  for (int i = 1; i <= lua_gettop(lua); ++i) self.show_result(lua, i);
  return 0;
}

void LuaInterpreter::show_result(lua_State* lua, int index) {
  if (const CommandHandle* const command = command_at(lua, index)) {
    show_command(command_name(lua, index), *command);
  } else {
    listener_.say(text_at(lua, index, options_.most_elements));
  }
}

/// One that has only to be accepted has ended a moment later, and that is told anyway.
void LuaInterpreter::show_command(const std::string& name, const CommandHandle& command) {
  const base::Time soon = application_.now() + (options_.simulated ? base::Duration::zero() : 50ms);
  course_.pass(soon, [&] { return command.ended(); });
  const bool known = std::any_of(begun_.begin(), begun_.end(),
                                 [&](const Begun& one) { return one.command == &command; });
  if (!command.ended() || !known) listener_.tell(inspect::status_of(name, command));
}

void LuaInterpreter::note_begun(lua_State* lua, const std::string& name) {
  CommandHandle* const command = command_at(lua, -1);
  lua_pushvalue(lua, -1);
  begun_.push_back({name, command, luaL_ref(lua, LUA_REGISTRYINDEX)});
}

void LuaInterpreter::tell_ended() {
  for (std::size_t i = 0; i < begun_.size();) {
    if (!begun_[i].command->ended()) {
      ++i;
      continue;
    }
    listener_.tell(inspect::status_of(begun_[i].name, *begun_[i].command));
    luaL_unref(sandbox_.lua(), LUA_REGISTRYINDEX, begun_[i].reference);
    begun_.erase(begun_.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

void LuaInterpreter::show_progress() {
  const base::Time now = platform::monotonic_now();
  if (quiet_ || now < next_progress_) return;
  next_progress_ = now + kProgressPeriod;
  std::vector<inspect::CommandStatus> commands;
  for (const Begun& one : begun_) commands.push_back(inspect::status_of(one.name, *one.command));
  listener_.show_progress(commands);
}

void LuaInterpreter::tell(const base::Diagnostic& mistake) {
  if (mistake.message == kInterrupted) {
    listener_.say(kInterrupted);
    return;
  }
  std::string text = "error: " + mistake.message;
  if (mistake.where.file != kName) {
    text = base::to_text(mistake);
  } else if (several_lines_ && mistake.where.line > 0) {
    text += " (in line " + std::to_string(mistake.where.line) + ")";
  }
  listener_.complain(text);
}

// --- running -------------------------------------------------------------------------------------

/// Asked every thousand instructions.
std::string LuaInterpreter::reason_to_end() {
  if (listener_.interrupted()) return kInterrupted;
  const base::Time now = platform::monotonic_now();
  if (options_.simulated || now < next_look_) return {};
  next_look_ = now + kLookPeriod;
  return course_.keep_up() ? std::string() : "the application ends";
}

/// An expression gives its value. What is local at the prompt would be gone with its line.
bool LuaInterpreter::compile_line(lua_State* lua, const std::string& text) {
  constexpr std::string_view kLocal = "local ";
  if (compile(lua, "return " + text, kName)) return true;
  lua_pop(lua, 1);
  if (text.starts_with(kLocal)) {
    if (compile(lua, text.substr(kLocal.size()), kName)) return true;
    lua_pop(lua, 1);
  }
  return compile(lua, text, kName);
}

bool LuaInterpreter::is_incomplete(const std::string& text) {
  constexpr std::string_view kEnd = "<eof>";
  bool incomplete = false;
  const base::Result<void> read = sandbox_.run_protected([&](lua_State* lua) {
    if (!compile_line(lua, text)) incomplete = text_at(lua, -1).ends_with(kEnd);
  });
  return read.ok() && incomplete;
}

lua_State* LuaInterpreter::begin(const std::string& text) {
  lua_State* part = nullptr;
  const base::Result<void> read = sandbox_.run_protected([&](lua_State* lua) {
    lua_getfield(lua, LUA_REGISTRYINDEX, kShowing);
    if (!compile_line(lua, text)) lua_error(lua);
    lua_call(lua, 1, 1);
    part = schedule_.add(lua);
  });
  if (!read) tell(sources_.diagnostic(sandbox_.lua(), read.error()));
  return part;
}

bool LuaInterpreter::run(const std::string& text) {
  several_lines_ = text.find('\n') != std::string::npos;
  const lua_State* const part = begin(text);
  if (part == nullptr) return false;
  const bool good = follow(part);
  listener_.end_progress();
  tell_ended();
  listener_.take_interrupt();
  return good;
}

bool LuaInterpreter::catch_up() {
  course_.keep_up();
  base::Diagnostics mistakes;
  const Schedule::Turn turn = schedule_.run_what_is_due(mistakes);
  for (const base::Diagnostic& mistake : mistakes.all()) tell(mistake);
  if (turn == Schedule::Turn::kStopped) course_.stop();
  tell_ended();
  for (const Events::Loss& loss : schedule_.events().take_losses()) {
    listener_.complain("warning: " + text_of(loss));
  }
  return !course_.has_ended();
}

bool LuaInterpreter::follow(const lua_State* part) {
  bool cancelled = false;
  while (true) {
    base::Diagnostics mistakes;
    const Schedule::Turn turn = schedule_.run_what_is_due(mistakes);
    for (const base::Diagnostic& mistake : mistakes.all()) tell(mistake);
    if (turn == Schedule::Turn::kStopped) course_.stop();
    if (course_.has_ended()) return true;
    if (!schedule_.has(part)) return turn != Schedule::Turn::kMistaken;
    if (turn == Schedule::Turn::kMistaken) continue;
    wait_until(base::Time::max(), {});
    if (!listener_.take_interrupt()) continue;
    if (!std::exchange(cancelled, true) && schedule_.awaits_command(part) && cancel_commands()) {
      continue;
    }
    schedule_.drop(part);
    listener_.say(kInterrupted);
    return true;
  }
}

bool LuaInterpreter::wait_until(base::Time until, const std::function<bool()>& also) {
  const auto wakes = [&] {
    show_progress();
    return listener_.interrupted() || schedule_.news_came() || (also && also());
  };
  const bool goes_on = course_.pass(std::min(until, schedule_.next_due()), wakes);
  const bool cut_short = listener_.interrupted() || (also && also());
  if (std::any_of(begun_.begin(), begun_.end(),
                  [](const Begun& one) { return one.command->ended(); })) {
    listener_.end_progress();
    tell_ended();
  }
  return goes_on && !cut_short;
}

bool LuaInterpreter::let_pass(base::Duration duration, const std::function<bool()>& also) {
  const base::Time until = base::later(application_.now(), duration);
  quiet_ = static_cast<bool>(also);
  bool goes_on = catch_up();
  while (goes_on && application_.now() < until) goes_on = wait_until(until, also) && catch_up();
  quiet_ = false;
  return goes_on;
}

void LuaInterpreter::wait_for_commands() {
  const auto all_ended = [&] {
    return std::all_of(begun_.begin(), begun_.end(),
                       [](const Begun& one) { return one.command->ended(); });
  };
  bool cancelled = false;
  while (!all_ended() && catch_up()) {
    wait_until(base::Time::max(), all_ended);
    if (listener_.take_interrupt() && (std::exchange(cancelled, true) || !cancel_commands())) break;
  }
  listener_.end_progress();
  catch_up();
}

bool LuaInterpreter::cancel_commands() {
  bool any = false;
  for (const Begun& one : begun_) {
    if (one.command->ended()) continue;
    one.command->cancel();
    any = true;
  }
  return any;
}

std::vector<std::string> LuaInterpreter::names_in(const std::string& table) {
  std::vector<std::string> names;
  const base::Result<void> read = sandbox_.run_protected([&](lua_State* lua) {
    lua_pushglobaltable(lua);
    if (!table.empty()) {
      lua_pushlstring(lua, table.data(), table.size());
      lua_rawget(lua, -2);
    }
    if (!lua_istable(lua, -1)) return;
    for (lua_pushnil(lua); lua_next(lua, -2) != 0; lua_pop(lua, 1)) {
      if (lua_type(lua, -2) == LUA_TSTRING) names.emplace_back(lua_tostring(lua, -2));
    }
  });
  std::sort(names.begin(), names.end());
  return read ? names : std::vector<std::string>();
}

}  // namespace armature::lua::internal

namespace armature::lua {

std::unique_ptr<Interpreter> make_interpreter(exec::Application& application, Course& course,
                                              Listener& listener,
                                              const InterpreterOptions& options) {
  return std::make_unique<internal::LuaInterpreter>(application, course, listener, options);
}

}  // namespace armature::lua
