// SPDX-License-Identifier: Apache-2.0
#include "armature/browser/internal/task_browser.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <iterator>
#include <optional>
#include <span>
#include <vector>

#include "armature/base/seconds.hpp"
#include "armature/browser/internal/help.hpp"
#include "armature/browser/internal/listing.hpp"
#include "armature/browser/internal/watch.hpp"

namespace armature::browser::internal {
namespace {

/// An older value is told with its age.
constexpr base::Duration kOld = std::chrono::seconds(1);
constexpr double kLogLines = 20;

std::string_view first_word(std::string_view line) {
  return line.substr(0, std::min(line.find_first_of(" \t"), line.size()));
}

std::string behind_first_word(std::string_view line) {
  return trimmed(line.substr(first_word(line).size()));
}

bool has_value(const inspect::ComponentDescription& component, const std::string& member) {
  const auto is_it = [&](const auto& one) { return one.name == member; };
  return std::ranges::any_of(component.properties, is_it) ||
         std::ranges::any_of(component.inputs, is_it) ||
         std::ranges::any_of(component.outputs, is_it);
}

/// What follows a member where a part of its value is meant: `[2].x`.
bool names_part(std::string_view rest) {
  constexpr std::string_view kPart = ".[]";
  return std::ranges::all_of(
      rest, [&](char c) { return is_name_character(c) || kPart.find(c) != kPart.npos; });
}

std::string text_of(const exec::Pace& pace) {
  if (pace.paused) return "paused";
  if (pace.rate == exec::kAsFastAsPossible) return "as fast as possible";
  return number_text("%.9g s in a second", pace.rate);
}

/// A text that is a number and nothing else.
std::optional<double> number_in(const std::string& text) {
  double number = 0.0;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, number);
  const bool whole = read.ec == std::errc{} && read.ptr == end;
  return whole ? std::optional(number) : std::nullopt;
}

std::string as_one_text(const Words& words) {
  std::string text;
  for (const std::string& word : words) text += word + " ";
  return trimmed(text);
}

}  // namespace

struct TaskBrowser::Command {
  std::string_view name;
  std::string_view topic;  ///< in the vocabulary, which has it if the language does
  void (TaskBrowser::*act)(const Words& arguments);
};

Completion TaskBrowser::complete(std::string_view before_cursor) {
  try {
    return internal::complete(view_, language_, before_cursor);
  } catch (const inspect::NoAnswer&) {
    return {};
  }
}

// --- lines ---------------------------------------------------------------------------------------

void TaskBrowser::take(std::string_view line) {
  surface().take_interrupt();
  if (wants_more()) return language_.take(line);
  const std::string text = trimmed(line);
  if (text.empty()) return;
  const bool leaves = text == "quit" || text == "exit";
  if (!leaves && !session_.is_ready()) return;
  try {
    take_whole(text);
  } catch (const inspect::NoAnswer& problem) {
    surface().end_keys();
    surface().show("");
    answers_.mistake(problem.what());
  }
  session_.end_line();
}

void TaskBrowser::take_whole(const std::string& line) {
  if (const Command* const command = command_of(line)) {
    (this->*command->act)(words_of(behind_first_word(line)));
  } else if (language_.is_statement(line) || !take_item(line)) {
    language_.take(line);
  }
}

const TaskBrowser::Command* TaskBrowser::find_command(std::string_view name) {
  static constexpr Command kCommands[] = {
      {"ls", "ls", &TaskBrowser::list},
      {"list", "ls", &TaskBrowser::list},
      {"help", "help", &TaskBrowser::help},
      {"?", "help", &TaskBrowser::help},
      {"watch", "watch", &TaskBrowser::watch},
      {"threads", "threads", &TaskBrowser::threads},
      {"faults", "faults", &TaskBrowser::faults},
      {"log", "log", &TaskBrowser::log},
      {"start", "start", &TaskBrowser::start},
      {"stop", "stop", &TaskBrowser::stop_components},
      {"reset", "reset", &TaskBrowser::reset},
      {"recover", "recover", &TaskBrowser::recover},
      {"cleanup", "cleanup", &TaskBrowser::clean_up},
      {"run", "run", &TaskBrowser::run},
      {"wait", "wait", &TaskBrowser::wait},
      {"pace", "pace", &TaskBrowser::pace},
      {"cancel", "cancel", &TaskBrowser::cancel},
      {"quit", "quit", &TaskBrowser::quit},
      {"exit", "quit", &TaskBrowser::quit},
  };
  const auto* const found = std::ranges::find(kCommands, name, &Command::name);
  return found == std::end(kCommands) ? nullptr : found;
}

/// The command that is the first word of a line, unless the language goes on behind it.
const TaskBrowser::Command* TaskBrowser::command_of(std::string_view line) const {
  const Command* const command = find_command(first_word(line));
  const bool meant = command != nullptr && vocabulary().has_command(command->topic) &&
                     !language_.goes_on(behind_first_word(line));
  return meant ? command : nullptr;
}

/// `Joint1`, `Joint1.Position`, `Sensor.sensor[2]`: what it is now, with its unit.
bool TaskBrowser::take_item(const std::string& line) {
  if (!view_.find(line).empty()) {
    list({line});
    return true;
  }
  const base::Result<MemberName> member = view_.member_in(line);
  if (!member || !names_part(member.value().rest)) return false;
  if (!has_value(view_.interface_of(member.value().component), member.value().member)) {
    if (member.value().rest.empty()) help({line});
    return member.value().rest.empty();
  }
  const inspect::ItemValue value = view_.read({line}, kAskedElements).at(0);
  if (value.type.empty()) return false;
  if (!value.error.empty()) {
    answers_.mistake(value.error);
  } else if (!value.written) {
    answers_.say("not yet written");
  } else {
    const bool is_old = session_.tells_ages() && value.age >= kOld;
    answers_.say(with_unit(value.value, value.unit) +
                 (is_old ? number_text(", %.3g s old", base::to_seconds(value.age)) : ""));
  }
  return true;
}

bool TaskBrowser::takes_nothing(std::string_view command, const Words& arguments) {
  if (arguments.empty()) return true;
  answers_.mistake(std::string(command) + " takes no arguments, found '" + arguments.front() + "'");
  return false;
}

// --- commands that show --------------------------------------------------------------------------

void TaskBrowser::list(const Words& names) {
  if (names.empty()) {
    answers_.say(list_components(paper(), view_.components()));
    const std::vector<lua::MachineStatus> machines = language_.machines();
    if (!machines.empty()) answers_.say(list_machines(paper(), machines));
  }
  for (const std::string& name : names) {
    if (const std::string component = view_.find(name); !component.empty()) {
      answers_.say(list_members(paper(), view_.look_at(component)));
    } else if (const auto member = view_.member_in(name); member) {
      help({name});
    } else {
      answers_.mistake(member.error());
    }
  }
}

void TaskBrowser::help(const Words& subjects) {
  if (subjects.empty()) answers_.say(help_overview(paper(), vocabulary()));
  for (const std::string& subject : subjects) {
    const base::Result<std::string> text = help_on(paper(), view_, vocabulary(), subject);
    text ? answers_.say(text.value()) : answers_.mistake(text.error());
  }
}

void TaskBrowser::threads(const Words& arguments) {
  if (takes_nothing("threads", arguments)) {
    answers_.say(list_threads(paper(), view_.status().threads));
  }
}

/// The newest lines, of as many as are kept.
void TaskBrowser::log(const Words& arguments) {
  const auto wanted = arguments.empty() ? std::optional(kLogLines) : number_in(arguments.front());
  if (arguments.size() > 1 || !wanted || *wanted < 1) {
    return answers_.mistake("log takes a number of lines above 0: log 50");
  }
  std::vector<exec::LogLine> lines;
  for (inspect::LogLines more = view_.log(0); !more.lines.empty();) {
    lines.insert(lines.end(), more.lines.begin(), more.lines.end());
    more = view_.log(lines.back().number);
  }
  const auto shown = std::min(static_cast<double>(lines.size()), *wanted);
  answers_.say(list_log(paper(), std::span(lines).last(static_cast<std::size_t>(shown))));
}

void TaskBrowser::faults(const Words& arguments) {
  if (takes_nothing("faults", arguments)) answers_.say(list_faults(paper(), view_.faults()));
}

void TaskBrowser::watch(const Words& words) {
  const base::Result<Watch> watch = Watch::parse(view_, words);
  if (!watch) return answers_.mistake(watch.error());
  surface().begin_keys();
  if (surface().live() && !session_.simulated()) {
    watch_in_place(watch.value(), view_, session_, surface());
  } else {
    watch_by_lines(watch.value(), view_, session_, surface());
  }
  surface().end_keys();
  surface().take_interrupt();
}

// --- time and commands under way -----------------------------------------------------------------

void TaskBrowser::let_pass(const Words& duration, std::string_view wanted) {
  const auto time = seconds_in(as_one_text(duration));
  if (!time) return answers_.mistake(wanted);
  const bool whole = session_.let_pass(*time, {});
  surface().show("");
  if (!whole && surface().take_interrupt()) answers_.say(session_.interrupted_text());
}

void TaskBrowser::run(const Words& arguments) {
  let_pass(arguments, "run takes the seconds to let pass, above 0: run 5");
}

void TaskBrowser::wait(const Words& arguments) {
  if (arguments.empty()) {
    session_.wait_for_commands();
  } else {
    let_pass(arguments, "wait takes the seconds to wait, above 0: wait 5");
  }
}

void TaskBrowser::pace(const Words& arguments) {
  const exec::Pace now = view_.pace();
  const std::string wanted = as_one_text(arguments);
  if (wanted.empty()) return answers_.say(text_of(now));
  if (wanted == "pause") return answers_.say(text_of(view_.set_pace({now.rate, true})));
  if (wanted == "go") return answers_.say(text_of(view_.set_pace({now.rate, false})));
  if (wanted == "step") return answers_.say(text_of(view_.step()));
  if (wanted == "most") return answers_.say(text_of(view_.set_pace({})));
  if (const auto rate = number_in(wanted)) {
    return answers_.say(text_of(view_.set_pace({*rate, false})));
  }
  answers_.mistake(
      "pace takes simulated seconds in a second, or most, pause, step or go: pace 0.1");
}

void TaskBrowser::cancel(const Words& arguments) {
  if (!takes_nothing("cancel", arguments)) return;
  if (!session_.cancel_commands()) answers_.say("no command is under way");
}

void TaskBrowser::quit(const Words& arguments) {
  if (takes_nothing("quit", arguments)) session_.stop();
}

}  // namespace armature::browser::internal
