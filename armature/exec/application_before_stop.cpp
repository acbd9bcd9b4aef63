// SPDX-License-Identifier: Apache-2.0
// Of Application: what the deployment has done before an orderly stop, and what is not let go of in
// silence.
#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "armature/component/author.hpp"
#include "armature/exec/application.hpp"
#include "armature/exec/internal/directory.hpp"
#include "armature/exec/internal/tool_ticket.hpp"
#include "armature/exec/internal/wiring.hpp"
#include "armature/platform/stop_signal.hpp"

namespace armature::exec {
namespace {

using component::Component;
using component::Outcome;
using internal::quoted;

/// How often components are asked what they hold.
constexpr base::Duration kLookPeriod = std::chrono::milliseconds(50);

constexpr auto is_under_way = [](const auto& ticket) {
  return ticket->stage() == component::CommandStage::kAccepted;
};

std::string seconds(base::Duration duration) {
  return std::to_string(duration / std::chrono::seconds(1)) + " s";
}

std::string dotted(const CommandName& name) { return quoted(name.component + "." + name.command); }

/// The signal that has ended the run is heard; the next one counts again.
const platform::StopSignal* heard(const platform::StopSignal* stop) {
  if (stop != nullptr && stop->received()) stop->hear_next();
  return stop;
}

}  // namespace

base::Diagnostics Application::run_before_stop(RunEnd end, const platform::StopSignal* stop,
                                               Leave leave) {
  base::Diagnostics diagnostics;
  if (!running_ || died_) return diagnostics;
  leaving_ = true;
  stop = heard(stop);
  // What is under way would have what follows refused; whoever began it has gone.
  bool cut_short = cancel_all(stop);
  const bool faulted = end == RunEnd::kFaulted || end == RunEnd::kStoppedByReaction;
  if (faulted || leave == Leave::kAfterMistake) return diagnostics;
  for (const CommandName& name : options_.before_stop) {
    if (cut_short || !in_good_order()) break;
    const Component* const component = find(name.component);
    const bool may_hold = component != nullptr && !component->interface().holdings.empty();
    if (may_hold && holds_nothing(name.component)) continue;
    const std::string problem = run_last(name, stop);
    cut_short = stop != nullptr && stop->received();
    if (problem.empty()) continue;
    diagnostics.error({}, "before the stop, " + dotted(name) + " " + problem);
  }
  return diagnostics;
}

/// @return whether a signal came meanwhile
bool Application::cancel_all(const platform::StopSignal* stop) {
  bool any = false;
  for (const auto& ticket : tickets_) {
    if (!is_under_way(ticket)) continue;
    ticket->request_cancel();
    any = true;
  }
  if (!any) return false;
  const RunEnd end = run_until(
      base::later(now(), options_.before_stop_limit),
      [this] { return std::ranges::none_of(tickets_, is_under_way); }, stop);
  return end == RunEnd::kStopRequested;
}

/// What went wrong; empty if it is done.
std::string Application::run_last(const CommandName& name, const platform::StopSignal* stop) {
  auto begun = begin(name.component, name.command, {});
  if (!begun) return "was refused: " + begun.error();
  component::CommandHandle handle = std::move(begun).value();
  const RunEnd end = run_until(
      base::later(now(), options_.before_stop_limit),
      [&] { return handle.ended() || !in_good_order(); }, stop);
  if (end == RunEnd::kStopRequested) {
    handle.cancel();
    return "was cut short by a signal";
  }
  if (!in_good_order()) return "was ended by a fault";
  if (!handle.ended()) return "did not end within " + seconds(options_.before_stop_limit);
  if (handle.stage() == component::CommandStage::kDone) return {};
  return "was not done: " + std::string(handle.reason());
}

// ---- What is held

std::optional<Held> Application::held_by(Component& component) {
  const auto what = std::make_shared<component::Reason>();
  for (const component::Holding* holding : component.interface().holdings) {
    const bool asked = run_in_thread_of(component, [what, holding] { *what = holding->held(); });
    if (!asked) return Held{component.name(), "something, but its thread does not answer", false};
    if (!what->empty()) return Held{component.name(), std::string(what->view())};
  }
  return std::nullopt;
}

bool Application::holds_nothing(std::string_view name) {
  Component* const component = find(name);
  return !running_ || component == nullptr || component->interface().holdings.empty() ||
         !held_by(*component);
}

std::vector<Held> Application::held() {
  std::vector<Held> all;
  if (!running_) return all;
  for (const ComponentEntry& entry : blueprint_.components) {
    Component& component = *entry.component;
    if (component.interface().holdings.empty()) continue;
    if (std::optional<Held> one = held_by(component)) all.push_back(*std::move(one));
  }
  return all;
}

/// What another component holds only as long as `component` runs.
std::optional<Held> Application::held_by_help_of(const Component& component) {
  if (!running_) return std::nullopt;
  const auto needs_it = [&](const component::Holding* holding) {
    if (holding->kept_by() == nullptr) return false;
    const Index keeper = index_of_.at(holding->kept_by()->name());
    const auto all = internal::who_runs_for(blueprint_, plan_, keeper);
    return std::ranges::find(all, index_of_.at(component.name())) != all.end();
  };
  for (const ComponentEntry& entry : blueprint_.components) {
    Component& holder = *entry.component;
    if (&holder == &component) continue;
    if (std::ranges::none_of(holder.interface().holdings, needs_it)) continue;
    if (std::optional<Held> one = held_by(holder)) return one;
  }
  return std::nullopt;
}

void Application::say_held(const std::vector<Held>& held) {
  for (const Held& one : held)
    say("before the stop, " + quoted(one.component) + " holds " + one.what);
  say("it is held for at most " + seconds(options_.hold_at_stop) +
      " while you do that; Ctrl-C again, or `quit` typed again, lets go of it");
}

base::Diagnostics Application::hold_until_told(
    const platform::StopSignal* stop, const std::function<bool(base::Duration)>& converse) {
  base::Diagnostics diagnostics;
  if (died_) return diagnostics;
  std::vector<Held> held_now = held();
  std::erase_if(held_now, [&diagnostics](const Held& one) {
    if (one.answers) return false;
    diagnostics.error({}, quoted(one.component) +
                              " may have held something: its thread does not answer, and holds "
                              "nothing any more");
    return true;
  });
  if (held_now.empty()) return diagnostics;
  leaving_ = true;
  stop = heard(stop);
  say_held(held_now);
  const base::Time end = base::later(now(), options_.hold_at_stop);
  const auto lets_go = [&](const char* why) {
    for (const Held& one : held_now) {
      diagnostics.error({},
                        quoted(one.component) + " lets go, since " + why + ": it held " + one.what);
    }
    return diagnostics;
  };
  if (converse && converse(options_.hold_at_stop)) {
    held_now = held();
    return lets_go("it was told to");
  }
  base::Time look = now();
  const auto let_go = [&] {
    if (now() < look) return false;
    look = base::later(now(), kLookPeriod);
    return (held_now = held()).empty();
  };
  const RunEnd ended = run_until(end, let_go, stop);
  if (ended == RunEnd::kConditionMet) return diagnostics;
  return lets_go(ended == RunEnd::kStopRequested ? "a signal came" : "no answer came");
}

// ---- The orderly stop of a component

/// A component that holds something does what is declared before a stop, and stops then.
Outcome Application::begin_way_to_stop(Component& component) {
  const auto way =
      std::ranges::find(options_.before_stop, component.name(), &CommandName::component);
  const std::optional<Held> held = held_by(component);
  std::string why = quoted(component.name()) + " was not stopped, since it holds " +
                    (held ? held->what : "something");
  if (way == options_.before_stop.end()) return component::refused(why);
  auto begun = begin(way->component, way->command, {});
  if (!begun) {
    return component::refused(why + " (" + dotted(*way) + " was refused: " + begun.error() + ")");
  }
  ways_to_stop_.push_back({*way, std::move(begun).value()});
  say(quoted(component.name()) + " stops when " + dotted(*way) + " is done");
  return component::accepted();
}

bool Application::is_on_way_to_stop(std::string_view name) const {
  return std::ranges::any_of(ways_to_stop_,
                             [&](const WayToStop& one) { return one.command.component == name; });
}

void Application::cancel_way_to_stop(std::string_view name) {
  for (WayToStop& one : ways_to_stop_) {
    if (one.command.component == name) one.handle.cancel();
  }
}

void Application::finish_ways_to_stop() {
  for (std::size_t i = 0; i < ways_to_stop_.size();) {
    if (!ways_to_stop_[i].handle.ended()) {
      ++i;
      continue;
    }
    const WayToStop done = std::move(ways_to_stop_[i]);
    ways_to_stop_.erase(ways_to_stop_.begin() + static_cast<std::ptrdiff_t>(i));
    if (done.handle.stage() != component::CommandStage::kDone) {
      say(quoted(done.command.component) + " was not stopped: " + dotted(done.command) + " " +
          std::string(name_of(done.handle.stage())) + ", " + std::string(done.handle.reason()));
      continue;
    }
    if (const auto held = held_by(*find(done.command.component))) {
      say(quoted(held->component) + " was not stopped: it still holds " + held->what);
      continue;
    }
    const Outcome stopped = stop_component(done.command.component);
    if (!stopped) say(std::string(stopped.reason()));
  }
}

}  // namespace armature::exec
