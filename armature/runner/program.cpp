// SPDX-License-Identifier: Apache-2.0
#include "armature/runner/program.hpp"

#include <optional>
#include <string_view>
#include <utility>

#include "armature/base/quoted.hpp"
#include "armature/platform/clock.hpp"
#include "armature/platform/memory.hpp"
#include "armature/runner/burial.hpp"
#include "armature/runner/fingerprint.hpp"
#include "armature/runner/internal/program_options.hpp"
#include "armature/runner/run_texts.hpp"
#include "armature/runner/stages.hpp"

namespace armature::runner {

using rt::LogLevel;

namespace {

/// Read descriptions of robots before the start; no thread runs any of it afterwards.
constexpr std::string_view kNeverRealTime[] = {"liburdfdom_model.so", "libtinyxml.so",
                                               "libconsole_bridge.so"};

bool add_models(const Program& program, component::Registry& models, const Console& console) {
  bool good = true;
  for (const LinkedLibrary& library : program.libraries) {
    const auto added = component::add_library(library.entry(), base::quoted(library.name), models);
    if (!added) console.say(LogLevel::kError, added.error());
    good &= added.ok();
  }
  return good;
}

/// What was checked is what runs: a component library may have changed since, or the code.
bool is_what_was_checked(const Program& program, Assembly& assembly, const Console& console) {
  console.show(assembly.mistakes());
  const bool same = fingerprint(assembly.blueprint(), assembly.options()) == program.fingerprint;
  if (assembly.mistakes().ok() && same) return true;
  console.say(LogLevel::kError,
              "this is not the application that passed the check when " +
                  base::quoted(program.name) +
                  " was generated: a component library, a data file or the generated code has "
                  "changed since; generate it again from its deployment");
  return false;
}

/// Lets go of nothing in silence: what is held is held until it is told, or the time is over.
base::Diagnostics leave(exec::Application& application, const platform::StopSignal& stop,
                        exec::RunEnd end) {
  base::Diagnostics problems = application.run_before_stop(end, &stop);
  problems.append(application.hold_until_told(&stop));
  return problems;
}

int run(exec::Blueprint blueprint, exec::ApplicationOptions options, const RunOptions& asked,
        Console& console) {
  // In simulated time nothing moves while somebody is waited for.
  std::optional<platform::Printer> printer;
  if (!asked.simulated) printer.emplace();
  if (!asked.simulated) console.set_begin(platform::monotonic_now());
  const platform::StopSignal stop;
  apply(asked, options);
  options.log = [&console](const rt::LogRecord& record) { console.log(record); };
  options.ready = [] { platform::release_code(kNeverRealTime); };
  exec::Application application(std::move(blueprint), std::move(options));
  const Burial burial(application, console);
  if (const int failed = start(application, asked, {}, console); failed != kDone) {
    if (application.hangs()) leave_now(failed, printer);
    return failed;
  }
  const Urgency urgency(asked, stop);
  const exec::RunEnd end = application.run_for(asked.longest(), &stop);
  const base::Diagnostics left = leave(application, stop, end);
  console.show(left);
  tell_casualties(application, console);
  const base::Diagnostics ended = application.stop();
  console.show(ended);
  tell_statistics(application, asked.statistics, console);
  tell_lost_lines(console);
  const int code = left.ok() && ended.ok() ? exit_code(end, application) : kFailed;
  if (application.hangs()) leave_now(code, printer);
  return code;
}

}  // namespace

int run_program(const Program& program, int argc, char** argv) {
  platform::survive_lost_outputs();
  Console console;
  const auto parsed = internal::parse_options({argv + 1, argv + argc});
  if (!parsed) {
    console.say(LogLevel::kError, parsed.error());
    return kWrongUse;
  }
  const internal::ProgramOptions& asked = parsed.value();
  if (asked.json) console.use_json();
  if (asked.help) {
    console.print(internal::help_of(program.name));
    return console.complete_output(kDone);
  }
  component::Registry models;
  if (!add_models(program, models, console)) return kFailed;
  Assembly assembly(models);
  program.assemble(assembly);
  if (!is_what_was_checked(program, assembly, console)) return kFailed;
  platform::FolderLock lock;
  if (!make_output_folder(asked.run.output_folder, lock, console)) return kFailed;
  exec::ApplicationOptions options = std::move(assembly.options());
  return console.complete_output(
      run(assembly.take_blueprint(), std::move(options), asked.run, console));
}

}  // namespace armature::runner
