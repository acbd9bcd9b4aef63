// SPDX-License-Identifier: Apache-2.0
#include "armature/browser/internal/life_cycle.hpp"

#include <algorithm>
#include <vector>

namespace armature::browser::internal {

using component::State;
using inspect::ComponentStatus;
using inspect::LifeCycleChange;

Words LifeCycle::all_in(State state) {
  Words names;
  for (const ComponentStatus& component : view_.components()) {
    if (component.state == state) names.push_back(component.name);
  }
  return names;
}

Words LifeCycle::change(const Words& names, inspect::LifeCycleChange change) {
  Words done;
  for (const std::string& name : names) {
    const std::string component = view_.find(name);
    if (component.empty()) {
      answers_.mistake(view_.no_component(name));
      continue;
    }
    const SpelledView::Changed changed = view_.change(component, change);
    changed.refusal.empty() ? done.push_back(component) : answers_.mistake(changed.refusal);
    answers_.say(component + ": " + changed.state);
  }
  return done;
}

void LifeCycle::start(const Words& names) {
  if (!names.empty()) {
    change(names, LifeCycleChange::kStart);
    return;
  }
  std::vector<ComponentStatus> resting = view_.components();
  std::erase_if(resting, [](const ComponentStatus& one) {
    const bool rests = one.state == State::kStopped || one.state == State::kPreOperational;
    return !rests || !one.autostart;
  });
  std::ranges::sort(resting, {}, &ComponentStatus::start_order);
  if (resting.empty()) answers_.say("no component is stopped");
  Words all;
  for (const ComponentStatus& one : resting) all.push_back(one.name);
  start_those_that_stopped_again(change(all, LifeCycleChange::kStart));
}

/// Hardware may take seconds to start. What it writes has become too old for its readers then, and
/// those that had been started before it have stopped.
void LifeCycle::start_those_that_stopped_again(const Words& started) {
  Words stopped;
  for (const std::string& name : all_in(State::kStopped)) {
    if (std::ranges::find(started, name) != started.end()) stopped.push_back(name);
  }
  change(stopped, LifeCycleChange::kStart);
}

void LifeCycle::stop(const Words& names, std::string_view quitting) {
  if (names.empty()) {
    answers_.mistake("stop takes the name of a component: stop Joint1; `quit` " +
                     std::string(quitting));
  }
  change(names, LifeCycleChange::kStop);
}

void LifeCycle::reset(const Words& names) {
  const Words all = names.empty() ? all_in(State::kException) : names;
  if (all.empty()) answers_.say("no component is in an exception");
  change(all, LifeCycleChange::kReset);
}

void LifeCycle::clean_up(const Words& names) {
  if (names.empty()) answers_.mistake("cleanup takes the name of a component: cleanup Joint1");
  change(names, LifeCycleChange::kCleanup);
}

void LifeCycle::recover(const Words& names) {
  const Words all = names.empty() ? all_in(State::kRunTimeError) : names;
  if (all.empty()) answers_.say("no component is in a run-time error");
  change(all, LifeCycleChange::kRecover);
}

}  // namespace armature::browser::internal
