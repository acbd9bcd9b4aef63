// SPDX-License-Identifier: Apache-2.0
#include "armature/browser/internal/remote_browser.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <utility>

#include "armature/base/near_name.hpp"
#include "armature/base/seconds.hpp"
#include "armature/browser/internal/command_texts.hpp"
#include "armature/browser/internal/help.hpp"
#include "armature/browser/internal/plain_values.hpp"
#include "armature/browser/internal/watch.hpp"
#include "armature/platform/clock.hpp"

namespace armature::browser::internal {
namespace {

using namespace std::chrono_literals;
using remote::CommandStatus;

/// Of commands that are under way, and of the connection.
constexpr base::Duration kLookPeriod = 100ms;
constexpr base::Duration kStep = 20ms;
/// A command that has only to be accepted has ended so soon.
constexpr base::Duration kSoon = 50ms;
/// A line that is typed while there is no connection waits so long for it.
constexpr base::Duration kReconnectionLimit = 3s;
/// An older value is told with its age.
constexpr double kOldSeconds = 1.0;

}  // namespace

RemoteBrowser::RemoteBrowser(RemoteRobot& robot, Surface& surface, Pause pause)
    : SharedCommands(robot, remote_language(), surface),
      there_(robot),
      pause_(std::move(pause)),
      name_(robot.address()) {
  there_.take_changes();
  greet();
}

/// Whoever may not read the application's own name still sees where it is.
void RemoteBrowser::greet() {
  try {
    has_application_ = there_.has_application();
    if (!has_application_ && !had_application_) {
      surface().complain("note: a node answers at " + there_.address() +
                         ", but no application that can be browsed; `list` shows what it hosts");
    }
    if (!has_application_) return;
    had_application_ = true;
    if (std::exchange(was_lost_, false)) {
      surface().complain("connected to " + there_.address() + " again");
    }
    name_ = there_.status().name;
  } catch (const NoAnswer& problem) {
    surface().complain("warning: " + std::string(problem.what()));
  }
}

Completion RemoteBrowser::complete(std::string_view before_cursor) {
  try {
    return internal::complete(robot(), remote_language(), {}, before_cursor);
  } catch (const NoAnswer&) {
    return {};
  }
}

void RemoteBrowser::stop() {
  ended_ = true;
  for (const CommandStatus& command : begun_) {
    surface().say(command.command +
                  ": cancelled, since it ends with the connection of who began it");
  }
}

bool RemoteBrowser::idle() {
  note_connection();
  follow_commands();
  return !ended_;
}

void RemoteBrowser::note_connection() {
  bool back = false;
  for (const ride::PeerChange& change : there_.take_changes()) {
    back = change.connected;
    there_.forget();
    if (change.connected) continue;
    was_lost_ = is_another_ = true;
    has_application_ = false;
    surface().complain("the connection to " + there_.address() +
                       " is lost: " + harmless(change.text) + "; it is tried again");
  }
  if (back) greet();
}

bool RemoteBrowser::wait_for_connection() {
  for (base::Duration passed{}; is_away() && passed < kReconnectionLimit; passed += kStep) {
    pause_(kStep);
    note_connection();
  }
  if (!is_away()) return true;
  const auto there = there_.wait_until_connected(base::Duration::zero());
  mistake(there ? "the process at " + there_.address() + " has no application now"
                : harmless(there.error()));
  return false;
}

// --- lines ---------------------------------------------------------------------------------------

void RemoteBrowser::take(std::string_view line) {
  surface().take_interrupt();
  const std::string text = trimmed(line);
  if (text.empty()) return;
  note_connection();
  const bool leaves = text == "quit" || text == "exit";
  if (!leaves && !wait_for_connection()) return;
  try {
    take_words(text);
  } catch (const NoAnswer& problem) {
    surface().end_keys();
    surface().show("");
    mistake(problem.what());
  }
  next_look_ = {};
  follow_commands();
}

void RemoteBrowser::take_words(const std::string& line) {
  if (take_command(line)) return;
  if (is_call(line)) return take_call(line);
  const Assignment assignment(line);
  if (!assignment.target.empty()) return take_assignment(assignment);
  take_item(line);
}

const RemoteBrowser::Command* RemoteBrowser::find_command(std::string_view name) {
  static const Command kCommands[] = {{"ls", &act<&RemoteBrowser::list>},
                                      {"list", &act<&RemoteBrowser::list>},
                                      {"help", &act<&RemoteBrowser::help>},
                                      {"?", &act<&RemoteBrowser::help>},
                                      {"watch", &act<&RemoteBrowser::watch>},
                                      {"threads", &act<&RemoteBrowser::threads>},
                                      {"faults", &act<&RemoteBrowser::faults>},
                                      {"start", &act<&RemoteBrowser::start>},
                                      {"stop", &act<&RemoteBrowser::stop_components>},
                                      {"reset", &act<&RemoteBrowser::reset>},
                                      {"recover", &act<&RemoteBrowser::recover>},
                                      {"cleanup", &act<&RemoteBrowser::clean_up>},
                                      {"wait", &act<&RemoteBrowser::wait>},
                                      {"cancel", &act<&RemoteBrowser::cancel>},
                                      {"quit", &act<&RemoteBrowser::quit>},
                                      {"exit", &act<&RemoteBrowser::quit>}};
  const auto* const found =
      std::ranges::find(kCommands, name, [](const Command& one) { return one.name; });
  return found == std::end(kCommands) ? nullptr : found;
}

bool RemoteBrowser::take_command(const std::string& line) {
  const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
  const Command* const command = find_command(std::string_view(line).substr(0, end));
  if (command == nullptr) return false;
  command->act(*this, words_of(trimmed(std::string_view(line).substr(end))));
  return true;
}

void RemoteBrowser::take_call(const std::string& line) {
  const base::Result<TypedCall> typed = parse_call(line);
  if (!typed) return mistake(typed.error());
  const TypedCall& call = typed.value();
  const std::string component = robot().find(call.component);
  if (component.empty()) return mistake(no_component(robot(), call.component));
  const remote::ComponentDetails details = robot().interface_of(component);
  const auto operation =
      std::ranges::find(details.operations, call.operation, &remote::OperationDetails::name);
  if (operation == details.operations.end()) {
    const auto member = member_in(robot(), component + ":" + call.operation);
    return mistake(member ? "'" + component + "." + call.operation + "' is no operation"
                          : member.error());
  }
  if (!operation->command) {
    const std::string result = there_.call(component, call.operation, call.arguments);
    if (!result.empty()) surface().say(result);
    return;
  }
  CommandStatus command = there_.begin(component, call.operation, call.arguments);
  for (base::Duration passed{}; !command.ended && passed < kSoon; passed += kStep) {
    pause_(kStep);
    command = there_.follow(command.handle);
  }
  if (!command.ended) begun_.push_back(command);
  surface().say(fate_text(paper(), command));
}

void RemoteBrowser::take_assignment(const Assignment& assignment) {
  const base::Result<std::string> value = as_in_files(assignment.value);
  if (!value) return mistake(assignment.target + ": " + value.error());
  const remote::ItemValue now = there_.write(assignment.target, value.value());
  surface().say(assignment.target + " = " + with_unit(now.value, now.unit));
}

void RemoteBrowser::take_item(const std::string& line) {
  if (!robot().find(line).empty()) return list({line});
  const auto member = member_in(robot(), line);
  if (!member) {
    if (line.find_first_of(".:") != std::string::npos) return mistake(member.error());
    std::vector<std::string> known = robot().component_names();
    for (const Topic& topic : remote_language().commands) known.emplace_back(topic.name);
    const std::string near = base::near_name(line, known);
    return mistake("there is no command and no component '" + line + "'" +
                   (near.empty() ? "" : " (did you mean '" + near + "'?)"));
  }
  const remote::ComponentDetails details = robot().interface_of(member.value().component);
  const auto is_it = [&](const auto& one) { return one.name == member.value().member; };
  const bool has_value = std::ranges::any_of(details.properties, is_it) ||
                         std::ranges::any_of(details.inputs, is_it) ||
                         std::ranges::any_of(details.outputs, is_it);
  if (!has_value) return help({line});
  const remote::ItemValue value = robot().read({line}, kAskedElements).at(0);
  if (!value.error.empty()) return mistake(value.error);
  if (!value.written) return surface().say("not yet written");
  surface().say(with_unit(value.value, value.unit) +
                (value.age >= kOldSeconds ? number_text(", %.3g s old", value.age) : ""));
}

// --- commands ------------------------------------------------------------------------------------

void RemoteBrowser::watch(const Words& words) {
  const base::Result<Watch> watch = Watch::parse(robot(), words);
  if (!watch) return mistake(watch.error());
  surface().begin_keys();
  if (surface().live()) {
    watch_in_place(watch.value());
  } else {
    watch_by_lines(watch.value());
  }
  surface().end_keys();
  surface().take_interrupt();
}

void RemoteBrowser::watch_in_place(const Watch& watch) {
  const base::Time end =
      base::later(platform::monotonic_now(), watch.limit().value_or(base::Duration::max()));
  const auto key_came = [&] { return surface().take_key(); };
  std::string picture;
  do {
    picture = watch.picture(paper(), robot());
    surface().show(picture + "\n" + inked(paper(), Ink::kFaint, "any key ends it"));
  } while (let_pass(watch.every(), key_came) && platform::monotonic_now() < end);
  surface().show("");
  surface().say(picture);
}

void RemoteBrowser::watch_by_lines(const Watch& watch) {
  constexpr int kUsualLines = 10;
  const base::Duration limit = watch.limit().value_or(kUsualLines * watch.every());
  if (const std::string heading = watch.heading(paper()); !heading.empty()) surface().say(heading);
  for (base::Duration passed{}; passed < limit; passed += watch.every()) {
    if (!let_pass(watch.every())) return;
    surface().say(watch.line(paper(), robot(), base::to_seconds(passed + watch.every())));
  }
}

bool RemoteBrowser::let_pass(base::Duration duration, const std::function<bool()>& also) {
  for (base::Duration passed{}; passed < duration; passed += kStep) {
    if (surface().interrupted() || (also && also()) || !idle()) return false;
    pause_(std::min(kStep, duration - passed));
  }
  return !surface().interrupted() && !(also && also());
}

void RemoteBrowser::wait(const Words& arguments) {
  if (!arguments.empty()) {
    std::string text;
    for (const std::string& word : arguments) text += word;
    const auto time = seconds_in(text);
    if (!time) return mistake("wait takes the seconds to wait, above 0: wait 5");
    let_pass(*time);
    return;
  }
  bool cancelled = false;
  while (!begun_.empty() && !ended_) {
    show_progress();
    if (!let_pass(kLookPeriod) && surface().take_interrupt() &&
        (std::exchange(cancelled, true) || !cancel_commands())) {
      break;
    }
  }
  surface().show("");
}

void RemoteBrowser::show_progress() {
  if (!surface().live()) return;
  surface().show(progress_text(begun_));
}

void RemoteBrowser::follow_commands() {
  const base::Time now = platform::monotonic_now();
  if (begun_.empty() || now < next_look_ || is_away()) return;
  next_look_ = now + kLookPeriod;
  std::erase_if(begun_, [&](CommandStatus& command) {
    try {
      command = there_.follow(command.handle);
    } catch (const NoAnswer& problem) {
      if (!is_another_ || is_away()) return false;
      surface().show("");
      surface().say(command.command + ": how it ended is not known: " + problem.what());
      return true;
    }
    if (command.ended) {
      surface().show("");
      surface().say(fate_text(paper(), command));
    }
    return command.ended;
  });
  if (!is_away()) is_another_ = false;
}

bool RemoteBrowser::cancel_commands() {
  for (const CommandStatus& command : begun_) there_.cancel(command.handle);
  return !begun_.empty();
}

void RemoteBrowser::cancel(const Words& arguments) {
  if (!takes_nothing("cancel", arguments)) return;
  if (!cancel_commands()) surface().say("no command is under way");
}

void RemoteBrowser::quit(const Words& arguments) {
  if (takes_nothing("quit", arguments)) stop();
}

}  // namespace armature::browser::internal
