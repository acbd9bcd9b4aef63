// SPDX-License-Identifier: Apache-2.0
#include "armature/browser/internal/shared_commands.hpp"

#include <algorithm>
#include <vector>

#include "armature/browser/internal/help.hpp"
#include "armature/browser/internal/listing.hpp"

namespace armature::browser::internal {

using component::State;
using remote::ComponentStatus;

void SharedCommands::mistake(std::string_view text) {
  const std::string error = "error: " + std::string(text);
  surface_.complain(surface_.live() ? wrapped(paper(), error, 0, 0) : error);
  ++mistakes_;
}

bool SharedCommands::takes_nothing(std::string_view command, const Words& arguments) {
  if (arguments.empty()) return true;
  mistake(std::string(command) + " takes nothing, found '" + arguments.front() + "'");
  return false;
}

void SharedCommands::list(const Words& names) {
  if (names.empty()) surface_.say(list_components(paper(), robot_.components()));
  for (const std::string& name : names) {
    if (const std::string component = robot_.find(name); !component.empty()) {
      surface_.say(list_members(paper(), robot_.look_at(component)));
    } else if (const auto member = member_in(robot_, name); member) {
      help({name});
    } else {
      mistake(member.error());
    }
  }
}

void SharedCommands::help(const Words& subjects) {
  if (subjects.empty()) surface_.say(help_overview(paper(), language_));
  for (const std::string& subject : subjects) {
    const base::Result<std::string> text = help_on(paper(), robot_, language_, subject);
    if (text) {
      surface_.say(text.value());
    } else {
      mistake(text.error());
    }
  }
}

void SharedCommands::threads(const Words& arguments) {
  if (takes_nothing("threads", arguments)) {
    surface_.say(list_threads(paper(), robot_.status().threads));
  }
}

void SharedCommands::faults(const Words& arguments) {
  if (takes_nothing("faults", arguments)) surface_.say(list_faults(paper(), robot_.faults()));
}

Words SharedCommands::all_in(State state) {
  Words names;
  for (const ComponentStatus& component : robot_.components()) {
    if (component.state == component::name_of(state)) names.push_back(component.name);
  }
  return names;
}

Words SharedCommands::change(const Words& names, const std::string& change) {
  Words done;
  for (const std::string& name : names) {
    const std::string component = robot_.find(name);
    if (component.empty()) {
      mistake(no_component(robot_, name));
      continue;
    }
    const Robot::Changed changed = robot_.change(component, change);
    changed.refusal.empty() ? done.push_back(component) : mistake(changed.refusal);
    surface_.say(component + ": " + changed.state);
  }
  return done;
}

void SharedCommands::start(const Words& names) {
  if (!names.empty()) {
    change(names, "start");
    return;
  }
  std::vector<ComponentStatus> resting = robot_.components();
  std::erase_if(resting, [](const ComponentStatus& one) {
    const bool rests = one.state == component::name_of(State::kStopped) ||
                       one.state == component::name_of(State::kPreOperational);
    return !rests || !one.autostart;
  });
  std::ranges::sort(resting, {}, &ComponentStatus::start_order);
  if (resting.empty()) surface_.say("no component is stopped");
  Words all;
  for (const ComponentStatus& one : resting) all.push_back(one.name);
  start_those_that_stopped_again(change(all, "start"));
}

/// Hardware may take seconds to start. What it writes has become too old for its readers then, and
/// those that had been started before it have stopped.
void SharedCommands::start_those_that_stopped_again(const Words& started) {
  Words stopped;
  for (const std::string& name : all_in(State::kStopped)) {
    if (std::ranges::find(started, name) != started.end()) stopped.push_back(name);
  }
  change(stopped, "start");
}

void SharedCommands::stop_components(const Words& names) {
  if (names.empty()) {
    mistake("stop takes the name of a component: stop Joint1; `quit` " +
            std::string(language_.quitting));
  }
  change(names, "stop");
}

void SharedCommands::reset(const Words& names) {
  const Words all = names.empty() ? all_in(State::kException) : names;
  if (all.empty()) surface_.say("no component is in an exception");
  change(all, "reset");
}

void SharedCommands::clean_up(const Words& names) {
  if (names.empty()) mistake("cleanup takes the name of a component: cleanup Joint1");
  change(names, "cleanup");
}

void SharedCommands::recover(const Words& names) {
  const Words all = names.empty() ? all_in(State::kRunTimeError) : names;
  if (all.empty()) surface_.say("no component is in a run-time error");
  change(all, "recover");
}

}  // namespace armature::browser::internal
