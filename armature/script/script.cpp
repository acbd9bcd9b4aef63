// SPDX-License-Identifier: Apache-2.0
#include "armature/script/script.hpp"

#include <algorithm>
#include <utility>

#include "armature/platform/file.hpp"
#include "armature/script/internal/components.hpp"
#include "armature/script/internal/sandbox.hpp"
#include "armature/script/internal/schedule.hpp"
#include "armature/script/internal/sources.hpp"
#include "armature/script/internal/standard.hpp"

namespace armature::script {

struct Script::Rest {
  Rest(Options its_options, const std::string& path)
      : options(std::move(its_options)),
        sources(path),
        sandbox(options.memory_limit, options.time_limit) {}

  Options options;
  internal::Sources sources;
  internal::Sandbox sandbox;
};

namespace {

using internal::Schedule;

/// Turns of the application's run and of the script's until one of them ends.
exec::RunEnd take_turns(Schedule& schedule, exec::Application& application, base::Time end,
                        const platform::StopSignal* stop, base::Diagnostics& diagnostics) {
  const std::function<bool()> command_ended = [&] { return schedule.command_ended(); };
  const std::function<bool()> never;
  while (true) {
    if (!schedule.run_what_is_due(diagnostics)) return exec::RunEnd::kStopRequested;
    const base::Time next = std::min(end, schedule.next_due());
    const bool waits = schedule.waits_for_commands();
    const exec::RunEnd ended = application.run_until(next, waits ? command_ended : never, stop);
    const bool goes_on = ended == exec::RunEnd::kTimeUp || ended == exec::RunEnd::kConditionMet;
    if (!goes_on) return ended;
    if (application.now() >= end) return exec::RunEnd::kTimeUp;
  }
}

}  // namespace

Script::Script(std::unique_ptr<Rest> rest) : rest_(std::move(rest)) {}
Script::Script(Script&& other) noexcept = default;
Script& Script::operator=(Script&& other) noexcept = default;
Script::~Script() = default;

exec::RunEnd Script::run(exec::Application& application, base::Duration duration,
                         const platform::StopSignal* stop, base::Diagnostics& diagnostics) {
  const base::Time end = base::later(application.now(), duration);
  Schedule schedule(rest_->sandbox, rest_->sources, application);
  const base::Result<void> ready = rest_->sandbox.run_protected([&](lua_State* lua) {
    lua_getfield(lua, LUA_REGISTRYINDEX, internal::kMainPart);
    schedule.install(lua);
    internal::install_components(lua, application);
  });
  if (!ready) {
    diagnostics.error({rest_->sources.path(), 0, 0}, ready.error());
    return exec::RunEnd::kStopRequested;
  }
  // What is due at the beginning comes first, so that there is something to look at.
  const exec::RunEnd begun = application.run_until(application.now(), nullptr, stop);
  if (begun != exec::RunEnd::kTimeUp) return begun;
  return take_turns(schedule, application, end, stop, diagnostics);
}

Script parse_script(std::string_view text, const std::string& path, Options options,
                    base::Diagnostics& diagnostics) {
  Script script(std::make_unique<Script::Rest>(std::move(options), path));
  Script::Rest& rest = *script.rest_;
  if (rest.sandbox.lua() == nullptr) {
    diagnostics.error({path, 0, 0}, "there is not enough memory for a script");
    return script;
  }
  const base::Result<void> read = rest.sandbox.run_protected([&](lua_State* lua) {
    internal::install_standard(lua, rest.options.print, rest.sources);
    if (!internal::compile(lua, text, rest.sources.name_of(path))) lua_error(lua);
    lua_setfield(lua, LUA_REGISTRYINDEX, internal::kMainPart);
  });
  if (!read) diagnostics.add(rest.sources.diagnostic(rest.sandbox.lua(), read.error()));
  return script;
}

Script load_script(const std::string& path, Options options, base::Diagnostics& diagnostics) {
  const base::Result<std::string> text = platform::read_file(path);
  if (!text) diagnostics.error({}, text.error());
  return parse_script(text ? text.value() : "", path, std::move(options), diagnostics);
}

namespace {

class Loaded final : public LoadedScript {
 public:
  explicit Loaded(Script script) : script_(std::move(script)) {}
  exec::RunEnd run(exec::Application& application, base::Duration duration,
                   const platform::StopSignal* stop, base::Diagnostics& diagnostics) override {
    return script_.run(application, duration, stop, diagnostics);
  }

 private:
  Script script_;
};

}  // namespace
}  // namespace armature::script

extern "C" armature::script::LoadedScript* armature_load_script(
    const std::string& path, armature::script::Options& options,
    armature::base::Diagnostics& diagnostics) {
  return new armature::script::Loaded(
      armature::script::load_script(path, std::move(options), diagnostics));
}
