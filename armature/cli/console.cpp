// SPDX-License-Identifier: Apache-2.0
#include "armature/cli/console.hpp"

#include <cstdio>
#include <string>

#include <nlohmann/json.hpp>

#include "armature/base/seconds.hpp"
#include "armature/platform/clock.hpp"

namespace armature::cli {
namespace {

std::string_view name_of(base::Severity severity) {
  switch (severity) {
    case base::Severity::kNote:
      return "note";
    case base::Severity::kWarning:
      return "warning";
    case base::Severity::kError:
      return "error";
  }
  return "error";
}

/// Users' files may hold anything; JSON must be UTF-8.
void print_json(const nlohmann::ordered_json& object) {
  const std::string text =
      object.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  std::fprintf(stderr, "%s\n", text.c_str());
}

}  // namespace

void Console::log(const rt::LogRecord& record) const {
  line(record.level, base::to_seconds(record.time - begin_), record.component.view(),
       record.message());
}

void Console::say(rt::LogLevel level, std::string_view text) const {
  if (!json_) {
    std::fprintf(stderr, "armature: %.*s\n", static_cast<int>(text.size()), text.data());
    return;
  }
  print_json({{"level", rt::name_of(level)}, {"component", "armature"}, {"message", text}});
}

void Console::show(const base::Diagnostics& diagnostics) const {
  if (!json_) {
    std::fputs(diagnostics.to_text().c_str(), stderr);
    return;
  }
  for (const base::Diagnostic& one : diagnostics.all()) {
    print_json({{"level", name_of(one.severity)},
                {"file", one.where.file},
                {"line", one.where.line},
                {"column", one.where.column},
                {"message", one.message},
                {"hint", one.hint}});
  }
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
  std::fprintf(stderr, "%12.6f %-7.*s %.*s: %.*s\n", seconds, static_cast<int>(name.size()),
               name.data(), static_cast<int>(component.size()), component.data(),
               static_cast<int>(text.size()), text.data());
}

}  // namespace armature::cli
