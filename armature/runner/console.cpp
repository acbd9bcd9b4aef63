// SPDX-License-Identifier: Apache-2.0
#include "armature/runner/console.hpp"

#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>

#include <nlohmann/json.hpp>

#include "armature/base/seconds.hpp"
#include "armature/base/severity_name.hpp"
#include "armature/platform/clock.hpp"
#include "armature/platform/printer.hpp"
#include "armature/platform/terminal.hpp"
#include "armature/runner/exit_code.hpp"

namespace armature::runner {
namespace {

void print_error_line(std::string_view text) {
  platform::print(platform::kStandardError, std::string(text) + '\n');
}

/// Users' files may hold anything; JSON must be UTF-8.
void print_json(const nlohmann::ordered_json& object) {
  const std::string text =
      object.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  print_error_line(text);
}

}  // namespace

void Console::log(const rt::LogRecord& record) const {
  line(record.level, base::to_seconds(record.time - begin_), record.component.view(),
       record.message());
}

void Console::say(rt::LogLevel level, std::string_view text) const {
  if (!json_) {
    return print_error_line("armature: " + std::string(text));
  }
  print_json({{"level", rt::name_of(level)}, {"component", "armature"}, {"message", text}});
}

void Console::show(const base::Diagnostics& diagnostics) const {
  if (!json_) {
    return platform::print(platform::kStandardError, diagnostics.to_text());
  }
  for (const base::Diagnostic& one : diagnostics.all()) {
    print_json({{"level", base::name_of(one.severity)},
                {"file", one.where.file},
                {"line", one.where.line},
                {"column", one.where.column},
                {"message", one.message},
                {"name", one.name},
                {"hint", one.hint}});
  }
}

void Console::print(std::string_view text) const {
  errno = 0;
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (!written && output_error_ == 0) output_error_ = errno;
}

int Console::complete_output(int code) const {
  errno = 0;
  const bool flushed = std::fflush(stdout) == 0;
  if (!flushed && output_error_ == 0) output_error_ = errno;
  if (output_error_ == EPIPE || (output_error_ == 0 && std::ferror(stdout) == 0)) return code;
  const int error = output_error_ != 0 ? output_error_ : EIO;
  say(rt::LogLevel::kError,
      "cannot write the standard output: " + std::generic_category().message(error));
  return code == kDone ? kFailed : code;
}

void Console::line(rt::LogLevel level, double seconds, std::string_view component,
                   std::string_view text) const {
  if (json_) {
    print_json({{"time", seconds},
                {"level", rt::name_of(level)},
                {"component", component},
                {"message", text}});
    return;
  }
  const std::string_view name = rt::name_of(level);
  char head[64];
  std::snprintf(head, sizeof head, "%12.6f %-7.*s ", seconds, static_cast<int>(name.size()),
                name.data());
  print_error_line(head + std::string(component) + ": " + std::string(text));
}

}  // namespace armature::runner
