// SPDX-License-Identifier: Apache-2.0
#include "armature/browser/internal/task_browser.hpp"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <optional>

#include "armature/base/seconds.hpp"
#include "armature/base/unit.hpp"
#include "armature/browser/internal/help.hpp"
#include "armature/browser/internal/items.hpp"
#include "armature/browser/internal/listing.hpp"
#include "armature/browser/internal/watch.hpp"

namespace armature::browser::internal {
namespace {

using component::Component;
using component::State;

}  // namespace

/// An assignment whose target may be an item.
struct TaskBrowser::ItemAssignment : Assignment {
  using Assignment::Assignment;
  std::optional<Item> item;
};

TaskBrowser::TaskBrowser(exec::Application& application, base::Duration duration,
                         const platform::StopSignal* stop, bool simulated, Surface& surface)
    : SharedCommands(robot_here_, lua_language(), surface),
      application_(application),
      robot_here_(application),
      simulated_(simulated),
      begin_(application.now()),
      course_(application, duration, stop),
      listener_(surface),
      interpreter_(
          lua::make_interpreter(application, course_, listener_,
                                {.simulated = simulated, .most_elements = kAskedElements})) {}

double TaskBrowser::seconds() const { return base::to_seconds(application_.now() - begin_); }

std::string TaskBrowser::prompt() const {
  if (wants_more()) return "... ";
  const std::string& name = application_.blueprint().name;
  return name + (simulated_ ? number_text(" %.9g s> ", seconds()) : "> ");
}

Completion TaskBrowser::complete(std::string_view before_cursor) {
  return internal::complete(
      robot(), lua_language(),
      [this](const std::string& table) { return interpreter_->names_in(table); }, before_cursor);
}

// --- lines ---------------------------------------------------------------------------------------

void TaskBrowser::take(std::string_view line) {
  surface().take_interrupt();
  if (wants_more()) {
    take_lua(lines_ + "\n" + std::string(line));
    return;
  }
  const std::string text = trimmed(line);
  if (text.empty() || take_command(text) || take_item(text)) return;
  take_lua(text);
}

const TaskBrowser::Command* TaskBrowser::find_command(std::string_view name) {
  static const Command kCommands[] = {{"ls", &act<&TaskBrowser::list>},
                                      {"list", &act<&TaskBrowser::list>},
                                      {"help", &act<&TaskBrowser::help>},
                                      {"?", &act<&TaskBrowser::help>},
                                      {"watch", &act<&TaskBrowser::watch>},
                                      {"threads", &act<&TaskBrowser::threads>},
                                      {"faults", &act<&TaskBrowser::faults>},
                                      {"start", &act<&TaskBrowser::start>},
                                      {"stop", &act<&TaskBrowser::stop_components>},
                                      {"reset", &act<&TaskBrowser::reset>},
                                      {"recover", &act<&TaskBrowser::recover>},
                                      {"cleanup", &act<&TaskBrowser::clean_up>},
                                      {"run", &act<&TaskBrowser::run>},
                                      {"wait", &act<&TaskBrowser::wait>},
                                      {"cancel", &act<&TaskBrowser::cancel>},
                                      {"quit", &act<&TaskBrowser::quit>},
                                      {"exit", &act<&TaskBrowser::quit>}};
  for (const Command& command : kCommands) {
    if (command.name == name) return &command;
  }
  return nullptr;
}

/// A command is the first word, but not where Lua goes on: `run = 5`, `wait(5)`, `ls.Position`.
bool TaskBrowser::take_command(const std::string& line) {
  const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
  const Command* const command = find_command(std::string_view(line).substr(0, end));
  if (command == nullptr) return false;
  const std::string rest = trimmed(std::string_view(line).substr(end));
  const bool lua = !rest.empty() &&
                   std::string_view("=([.:+*/%<>~^,;").find(rest.front()) != std::string_view::npos;
  if (lua) return false;
  command->act(*this, words_of(rest));
  return true;
}

/// `Joint1`, `Joint1.Position`, `Sensor.sensor[2]`: what it is now, with its unit.
bool TaskBrowser::take_item(const std::string& line) {
  if (find_component(application_, line) != nullptr) {
    list({line});
    return true;
  }
  if (const auto member = find_member(application_, line); member && !member.value().has_value()) {
    help({line});
    return true;
  }
  const base::Result<Item> item = find_item(application_, line);
  if (!item) return false;
  const auto readings = read_members(application_, {item.value().member});
  if (!readings) {
    mistake("the thread of '" + item.value().member.component->name() + "' does not answer");
    return true;
  }
  const void* const part = part_of(item.value(), readings->front().whole);
  if (part == nullptr) {
    mistake("'" + line + "' is not there: it is " +
            value_text(item.value().member.type(), readings->front().whole.data(), {}));
  } else if (!readings->front().written) {
    surface().say("not yet written");
  } else {
    surface().say(value_text(*item.value().type, part, item.value().unit, kAskedElements));
  }
  return true;
}

/// What Lua would take without a word, or not at all: a part of a copy, a value with its unit.
bool TaskBrowser::prepare(ItemAssignment& assignment) {
  const base::Result<Item> item = find_item(application_, assignment.target);
  if (!item) return true;
  assignment.item = item.value();
  const Member& member = item.value().member;
  if (!item.value().parts.empty() && member.property != nullptr) {
    mistake("'" + assignment.target + "' is a part of what was read: set the whole, " +
            member.name() + " = ...");
    return false;
  }
  const auto quantity = base::parse_quantity(assignment.value);
  if (!quantity || quantity.value().unit.empty()) return true;
  const auto number = base::convert(quantity.value().value, quantity.value().unit, member.unit());
  if (!number) {
    mistake(member.name() + ": " + number.error());
    return false;
  }
  assignment.value = number_text("%.17g", number.value());
  return true;
}

void TaskBrowser::take_lua(const std::string& text) {
  lines_.clear();
  ItemAssignment assignment(text);
  std::string lua = spelled_for_lua(application_, text);
  if (!assignment.target.empty()) {
    if (!prepare(assignment)) return;
    if (assignment.item) {
      lua = spelled_for_lua(application_, assignment.target) + " = " + assignment.value;
    }
  }
  if (interpreter_->is_incomplete(lua)) {
    lines_ = text;
    return;
  }
  if (!interpreter_->run(lua)) {
    count_mistake();
  } else if (assignment.item) {
    const auto readings = read_members(application_, {assignment.item->member});
    if (!readings) return;
    surface().say(assignment.item->text + " = " +
                  value_text(*assignment.item->type, readings->front().whole.data(),
                             assignment.item->unit, kAskedElements));
  }
}

// --- commands ------------------------------------------------------------------------------------

void TaskBrowser::list(const Words& names) {
  SharedCommands::list(names);
  if (names.empty() && !interpreter_->machines().empty()) {
    surface().say(list_machines(paper(), interpreter_->machines()));
  }
}

void TaskBrowser::watch(const Words& words) {
  const base::Result<Watch> watch = Watch::parse(robot(), words);
  if (!watch) {
    mistake(watch.error());
    return;
  }
  surface().begin_keys();
  if (surface().live() && !simulated_) {
    watch_in_place(watch.value());
  } else {
    watch_by_lines(watch.value());
  }
  surface().end_keys();
  surface().take_interrupt();
}

void TaskBrowser::watch_in_place(const Watch& watch) {
  const base::Time end =
      base::later(application_.now(), watch.limit().value_or(base::Duration::max()));
  bool key = false;
  const auto key_came = [&] { return key = key || surface().take_key(); };
  std::string picture;
  do {
    picture = watch.picture(paper(), robot());
    surface().show(picture + "\n" + inked(paper(), Ink::kFaint, "any key ends it"));
  } while (interpreter_->let_pass(std::min(watch.every(), end - application_.now()), key_came) &&
           application_.now() < end);
  surface().show("");
  surface().say(picture);
}

void TaskBrowser::watch_by_lines(const Watch& watch) {
  constexpr int kUsualLines = 10;
  const base::Time end =
      base::later(application_.now(), watch.limit().value_or(kUsualLines * watch.every()));
  bool key = false;
  const auto key_came = [&] { return key = key || surface().take_key(); };
  if (const std::string heading = watch.heading(paper()); !heading.empty()) surface().say(heading);
  while (application_.now() < end &&
         interpreter_->let_pass(std::min(watch.every(), end - application_.now()), key_came)) {
    surface().say(watch.line(paper(), robot(), seconds()));
  }
}

void TaskBrowser::run(const Words& arguments) {
  std::string text;
  for (const std::string& word : arguments) text += word + " ";
  const auto time = seconds_in(trimmed(text));
  if (!time) {
    mistake("run takes the seconds to let pass, above 0: run 5");
    return;
  }
  const bool whole = interpreter_->let_pass(*time, {});
  surface().show("");
  if (!whole && surface().take_interrupt()) {
    surface().say("interrupted at " + number_text("%.9g s", seconds()));
  }
}

void TaskBrowser::wait(const Words& arguments) {
  if (arguments.empty()) {
    interpreter_->wait_for_commands();
  } else {
    run(arguments);
  }
}

void TaskBrowser::cancel(const Words& arguments) {
  if (!takes_nothing("cancel", arguments)) return;
  if (!interpreter_->cancel_commands()) surface().say("no command is under way");
}

void TaskBrowser::quit(const Words& arguments) {
  if (takes_nothing("quit", arguments)) course_.stop();
}

}  // namespace armature::browser::internal
