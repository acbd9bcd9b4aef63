// SPDX-License-Identifier: Apache-2.0
#include "armature/cli/companions.hpp"

#include <string>
#include <string_view>
#include <utility>

#include "armature/platform/printer.hpp"
#include "armature/platform/terminal.hpp"

namespace armature::cli {
namespace {

/// What a script prints is what the program was asked for, so it goes to standard output.
void print_line(std::string_view line) {
  platform::print(platform::kStandardOutput, std::string(line) + '\n');
}

std::unique_ptr<lua::Script> script_of(const RunArguments& arguments,
                                       base::Diagnostics& diagnostics) {
  if (arguments.script.empty()) return nullptr;
  lua::Options options;
  options.print = print_line;
  return lua::load_script(arguments.script, std::move(options), diagnostics);
}

std::unique_ptr<record::TimelineWriter> timeline_of(const RunArguments& arguments,
                                                    base::Diagnostics& diagnostics) {
  if (arguments.trace.empty()) return nullptr;
  auto created = record::TimelineWriter::create(arguments.trace);
  if (created) return std::move(created).value();
  diagnostics.error({}, created.error());
  return nullptr;
}

/// Lines that come from a file are for whoever asks for them with --browse.
bool is_attended(const RunArguments& arguments) {
  return arguments.script.empty() && !arguments.duration &&
         platform::is_terminal(platform::kStandardInput);
}

}  // namespace

Companions make_companions(const RunArguments& arguments, bool prompted,
                           base::Diagnostics& diagnostics) {
  const bool browse = arguments.browse || (prompted && is_attended(arguments));
  return {.script = script_of(arguments, diagnostics),
          .browser = browse ? browser::make_browser(arguments.simulated) : nullptr,
          .timeline = timeline_of(arguments, diagnostics)};
}

}  // namespace armature::cli
