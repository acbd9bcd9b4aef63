// SPDX-License-Identifier: Apache-2.0
#include "armature/runner/internal/program_options.hpp"

#include <cmath>
#include <string_view>

#include "armature/base/near_name.hpp"
#include "armature/base/quoted.hpp"
#include "armature/base/unit.hpp"

namespace armature::runner::internal {

namespace {

/// An option, and what it does with its value; empty if the value is right, else what it must be.
struct Option {
  std::string_view name;
  std::string_view value;  ///< how the help calls it; empty: it has none
  std::string_view help;
  std::string_view (*take)(ProgramOptions& options, const std::string& value);
};

std::string_view take_duration(ProgramOptions& options, const std::string& value) {
  options.run.duration = parse_duration(value);
  return options.run.duration ? "" : "a duration above 0, for example 10s";
}

std::string_view take_pace(ProgramOptions& options, const std::string& value) {
  const auto rate = base::parse_quantity(value);
  const bool good = rate && rate.value().unit.empty() && rate.value().value > 0.0 &&
                    std::isfinite(rate.value().value);
  if (good) options.run.rate = rate.value().value;
  return good ? "" : "a number above 0";
}

std::string_view take_realtime(ProgramOptions& options, const std::string& value) {
  exec::RealtimeMode& mode = options.run.realtime;
  if (value == "off") return mode = exec::RealtimeMode::kOff, "";
  if (value == "prefer") return mode = exec::RealtimeMode::kPrefer, "";
  if (value == "require") return mode = exec::RealtimeMode::kRequire, "";
  return "off, prefer or require";
}

std::string_view take_folder(ProgramOptions& options, const std::string& value) {
  options.run.output_folder = value;
  return value.empty() ? "the name of a folder" : "";
}

constexpr Option kOptions[] = {
    {"--for", "TIME", "how long it runs, for example 10s or 500ms", take_duration},
    {"--sim", "", "runs in simulated time, as fast as possible",
     [](ProgramOptions& options, const std::string&) -> std::string_view {
       return options.run.simulated = true, "";
     }},
    {"--pace", "RATE", "simulated seconds in a second: 1 is real time", take_pace},
    {"--out", "FOLDER", "the folder for recordings; created if it is missing", take_folder},
    {"--realtime", "MODE", "off, prefer (default) or require", take_realtime},
    {"--statistics", "", "prints cycles and latencies at the end",
     [](ProgramOptions& options, const std::string&) -> std::string_view {
       return options.run.statistics = true, "";
     }},
    {"--log-json", "", "messages as JSON, one object a line",
     [](ProgramOptions& options, const std::string&) -> std::string_view {
       return options.json = true, "";
     }},
    {"--help", "", "prints this",
     [](ProgramOptions& options, const std::string&) -> std::string_view {
       return options.help = true, "";
     }}};

const Option* find(std::string_view name) {
  for (const Option& option : kOptions) {
    if (option.name == name) return &option;
  }
  return nullptr;
}

base::Error unknown(const std::string& word) {
  std::vector<std::string> names;
  for (const Option& option : kOptions) names.emplace_back(option.name);
  return base::Error{"unknown option " + base::quoted(word) +
                     base::suggestion_in_brackets(word, names) + "; --help lists all"};
}

}  // namespace

base::Result<ProgramOptions> parse_options(const std::vector<std::string>& words) {
  ProgramOptions options;
  bool paced = false;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::size_t equals = words[i].find('=');
    const std::string name = words[i].substr(0, equals);
    const Option* const option = find(name);
    if (option == nullptr) return unknown(name);
    const bool inside = equals != std::string::npos;
    if (option->value.empty() && inside) return base::Error{name + " takes no value"};
    std::string value = inside ? words[i].substr(equals + 1) : std::string();
    if (!option->value.empty() && !inside) {
      if (i + 1 == words.size()) return base::Error{name + " needs a value"};
      value = words[++i];
    }
    const std::string_view expected = option->take(options, value);
    if (!expected.empty()) {
      return base::Error{name + ": " + base::quoted(value) + " must be " + std::string(expected)};
    }
    paced |= name == "--pace";
  }
  if (paced && !options.run.simulated) return base::Error{"--pace needs --sim"};
  return options;
}

std::string help_of(const std::string& program) {
  std::string text = "usage: " + program + " [OPTIONS]\n\nRuns until stopped (Ctrl-C).\n\n";
  for (const Option& option : kOptions) {
    std::string head = "  " + std::string(option.name);
    if (!option.value.empty()) head += ' ' + std::string(option.value);
    head.resize(22, ' ');
    text += head + std::string(option.help) + '\n';
  }
  return text;
}

}  // namespace armature::runner::internal
