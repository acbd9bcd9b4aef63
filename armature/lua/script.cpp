// SPDX-License-Identifier: Apache-2.0
#include "armature/lua/script.hpp"

#include <algorithm>
#include <utility>

#include "armature/lua/internal/components.hpp"
#include "armature/lua/internal/sandbox.hpp"
#include "armature/lua/internal/schedule.hpp"
#include "armature/lua/internal/sources.hpp"
#include "armature/lua/internal/standard.hpp"
#include "armature/platform/file.hpp"

namespace armature::lua {

namespace {

using internal::Schedule;

/// Turns of the application's run and of the script's until one of them ends.
exec::RunEnd take_turns(Schedule& schedule, exec::Application& application, base::Time end,
                        const platform::StopSignal* stop, base::Diagnostics& diagnostics) {
  const std::function<bool()> news_came = [&] { return schedule.news_came(); };
  const std::function<bool()> never;
  while (true) {
    if (schedule.run_what_is_due(diagnostics) != Schedule::Turn::kDone) {
      return exec::RunEnd::kStopRequested;
    }
    const base::Time next = std::min(end, schedule.next_due());
    const bool waits = schedule.waits_for_news();
    const exec::RunEnd ended = application.run_until(next, waits ? news_came : never, stop);
    const bool goes_on = ended == exec::RunEnd::kTimeUp || ended == exec::RunEnd::kConditionMet;
    if (!goes_on) return ended;
    if (application.now() >= end) return exec::RunEnd::kTimeUp;
  }
}

class LuaScript final : public Script {
 public:
  LuaScript(Options options, const std::string& path)
      : options_(std::move(options)),
        sources_(path),
        sandbox_(options_.memory_limit, options_.time_limit) {}

  void parse(std::string_view text, base::Diagnostics& diagnostics);
  exec::RunEnd run(exec::Application& application, base::Duration duration,
                   const platform::StopSignal* stop, base::Diagnostics& diagnostics) override;

 private:
  Options options_;
  internal::Sources sources_;
  internal::Sandbox sandbox_;
};

void LuaScript::parse(std::string_view text, base::Diagnostics& diagnostics) {
  if (sandbox_.lua() == nullptr) {
    diagnostics.error({sources_.path(), 0, 0}, "not enough memory to load the script");
    return;
  }
  const base::Result<void> read = sandbox_.run_protected([&](lua_State* lua) {
    internal::install_standard(lua, options_.print, sources_);
    if (!internal::compile(lua, text, sources_.name_of(sources_.path()))) lua_error(lua);
    lua_setfield(lua, LUA_REGISTRYINDEX, internal::kMainPart);
  });
  if (!read) diagnostics.add(sources_.diagnostic(sandbox_.lua(), read.error()));
}

exec::RunEnd LuaScript::run(exec::Application& application, base::Duration duration,
                            const platform::StopSignal* stop, base::Diagnostics& diagnostics) {
  const base::Time end = base::later(application.now(), duration);
  Schedule schedule(sandbox_, sources_, application);
  const internal::Access access{application, exec::Caller::kScript};
  const base::Result<void> ready = sandbox_.run_protected([&](lua_State* lua) {
    schedule.install(lua);
    internal::install_components(lua, access);
    lua_getfield(lua, LUA_REGISTRYINDEX, internal::kMainPart);
    schedule.add(lua);
  });
  if (!ready) {
    diagnostics.error({sources_.path(), 0, 0}, ready.error());
    return exec::RunEnd::kStopRequested;
  }
  // What is due at the beginning comes first, so that there is something to look at.
  const exec::RunEnd begun = application.run_until(application.now(), nullptr, stop);
  if (begun != exec::RunEnd::kTimeUp) return begun;
  const exec::RunEnd ended = take_turns(schedule, application, end, stop, diagnostics);
  schedule.stop_machines(diagnostics);
  for (const internal::Events::Loss& loss : schedule.events().take_losses()) {
    diagnostics.warning({sources_.path(), 0, 0}, text_of(loss));
  }
  return ended;
}

}  // namespace

std::unique_ptr<Script> parse_script(std::string_view text, const std::string& path,
                                     Options options, base::Diagnostics& diagnostics) {
  auto script = std::make_unique<LuaScript>(std::move(options), path);
  script->parse(text, diagnostics);
  return script;
}

std::unique_ptr<Script> load_script(const std::string& path, Options options,
                                    base::Diagnostics& diagnostics) {
  const base::Result<std::string> text = platform::read_file(path);
  if (!text) diagnostics.error({}, text.error());
  return parse_script(text ? text.value() : "", path, std::move(options), diagnostics);
}

}  // namespace armature::lua
