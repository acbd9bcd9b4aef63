// SPDX-License-Identifier: Apache-2.0
#include "armature/cli/companions.hpp"

#include <string>
#include <string_view>

#include "armature/cli/loaded.hpp"
#include "armature/platform/printer.hpp"
#include "armature/platform/terminal.hpp"
#include "armature/record/black_box_file.hpp"

namespace armature::cli {
namespace {

constexpr const char* kLuaLibrary = "libarmature_lua.so";
constexpr const char* kBrowserLibrary = "libarmature_browser.so";
constexpr const char* kRecordLibrary = "libarmature_record.so";

/// What a script prints is what the program was asked for, so it goes to standard output.
void print_line(std::string_view line) {
  platform::print(platform::kStandardOutput, std::string(line) + '\n');
}

std::unique_ptr<lua::Script> load_script(const RunArguments& arguments,
                                         base::Diagnostics& diagnostics) {
  if (arguments.script.empty()) return nullptr;
  void* const load = load_function(kLuaLibrary, lua::kLoadScript, "scripts need", diagnostics);
  if (load == nullptr) return nullptr;
  lua::Options options;
  options.print = print_line;
  return std::unique_ptr<lua::Script>(
      reinterpret_cast<lua::LoadScript>(load)(arguments.script, options, diagnostics));
}

std::unique_ptr<browser::Browser> load_browser(const RunArguments& arguments,
                                               base::Diagnostics& diagnostics) {
  if (!arguments.browse) return nullptr;
  void* const make =
      load_function(kBrowserLibrary, browser::kMakeBrowser, "the task browser needs", diagnostics);
  if (make == nullptr) return nullptr;
  return std::unique_ptr<browser::Browser>(
      reinterpret_cast<browser::MakeBrowser>(make)(arguments.simulated));
}

std::unique_ptr<record::TimelineWriter> create_timeline(const RunArguments& arguments,
                                                        base::Diagnostics& diagnostics) {
  if (arguments.trace.empty()) return nullptr;
  void* const create =
      load_function(kRecordLibrary, record::kCreateTimelineWriter, "--trace needs", diagnostics);
  if (create == nullptr) return nullptr;
  std::string error;
  std::unique_ptr<record::TimelineWriter> writer(
      reinterpret_cast<record::CreateTimelineWriter>(create)(arguments.trace, error));
  if (writer == nullptr) diagnostics.error({}, error);
  return writer;
}

}  // namespace

Companions load_companions(const RunArguments& arguments, base::Diagnostics& diagnostics) {
  return {.script = load_script(arguments, diagnostics),
          .browser = load_browser(arguments, diagnostics),
          .timeline = create_timeline(arguments, diagnostics)};
}

std::string write_black_box(const exec::BlackBoxReport& report, const std::string& folder) {
  base::Diagnostics problems;
  void* const write =
      load_function(kRecordLibrary, record::kWriteBlackBox, "the black box needs", problems);
  if (write == nullptr) return problems.to_text();
  std::string said;
  reinterpret_cast<record::WriteBlackBox>(write)(report, folder, said);
  return said;
}

}  // namespace armature::cli
