// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/internal/application/before_stop.hpp"

#include <chrono>
#include <utility>

#include "armature/base/quoted.hpp"
#include "armature/component/interface.hpp"
#include "armature/exec/event_command.hpp"
#include "armature/platform/stop_signal.hpp"

namespace armature::exec::internal {
namespace {

using base::quoted;
using component::Component;

/// How often components are asked what they hold.
constexpr base::Duration kLookPeriod = std::chrono::milliseconds(50);

std::string seconds(base::Duration duration) {
  return std::to_string(duration / std::chrono::seconds(1)) + " s";
}

/// The signal that has ended the run is heard; the next one counts again.
const platform::StopSignal* heard(const platform::StopSignal* stop) {
  if (stop != nullptr && stop->received()) stop->hear_next();
  return stop;
}

/// Takes those out of `held` that cannot go on holding, and names them.
void give_up_silent(std::vector<Held>& held, base::Diagnostics& diagnostics) {
  std::erase_if(held, [&diagnostics](const Held& one) {
    if (one.answers) return false;
    diagnostics.error({}, quoted(one.component) +
                              " may have held something: its thread does not answer, and holds "
                              "nothing any more");
    return true;
  });
}

void name_let_go(const std::vector<Held>& held, const char* why, base::Diagnostics& diagnostics) {
  for (const Held& one : held) {
    diagnostics.error({},
                      quoted(one.component) + " lets go, since " + why + ": it held " + one.what);
  }
}

}  // namespace

// ---- Commands

base::Diagnostics BeforeStop::run_commands(RunEnd end, const platform::StopSignal* stop,
                                           Leave leave) {
  base::Diagnostics diagnostics;
  if (!health_.running() || health_.died()) return diagnostics;
  begin_to_leave();
  stop = heard(stop);
  // What is under way would have what follows refused; whoever began it has gone.
  bool cut_short = cancel_all(stop);
  const bool faulted = end == RunEnd::kFaulted || end == RunEnd::kStoppedByReaction;
  for (const CommandName& name : options_.before_stop) {
    if (holds_nothing(name.component)) continue;
    if (leave == Leave::kAfterMistake) {
      leave_out(name, "whoever commanded it made a mistake");
    } else if (cut_short) {
      leave_out(name, "a signal came");
    } else if (faulted || !health_.in_good_order()) {
      leave_out(name, "something has faulted or was stopped by a reaction");
    } else {
      cut_short = !do_it(name, stop, diagnostics);
    }
  }
  return diagnostics;
}

void BeforeStop::leave_out(const CommandName& name, const char* why) {
  outlets_.say("before the stop, " + dotted(name) + " is left out, since " + why);
}

/// @return whether no signal came meanwhile
bool BeforeStop::do_it(const CommandName& name, const platform::StopSignal* stop,
                       base::Diagnostics& diagnostics) {
  const std::string problem = run(name, stop);
  if (!problem.empty()) {
    diagnostics.error({}, "before the stop, " + dotted(name) + " " + problem);
  }
  return stop == nullptr || !stop->received();
}

/// What is done now is done at the operator's word: no event begins anything beside it, and nobody
/// has to let time pass.
void BeforeStop::begin_to_leave() {
  health_.begin_to_leave();
  loop_.set_pace({loop_.pace().rate, false});
  for (const ComponentEntry& entry : roster_.blueprint().components) {
    if (auto* wire = dynamic_cast<EventCommand*>(entry.component.get())) wire->rest();
  }
}

/// @return whether a signal came meanwhile
bool BeforeStop::cancel_all(const platform::StopSignal* stop) {
  if (!tickets_.cancel_all()) return false;
  const RunEnd end = loop_.run_until(
      base::later(clock_.now(), options_.before_stop_limit),
      [this] { return !tickets_.any_under_way(); }, stop);
  return end == RunEnd::kStopRequested;
}

/// A component that could hold something, and holds nothing now.
bool BeforeStop::holds_nothing(std::string_view name) const {
  Component* const component = roster_.find(name);
  const bool may_hold =
      component != nullptr && !component::interface_of(*component).holdings.empty();
  return may_hold && !holders_.held_by(*component);
}

/// What went wrong; empty if it is done.
std::string BeforeStop::run(const CommandName& name, const platform::StopSignal* stop) {
  auto begun = tools_.begin(name.component, name.command, {}, Caller::kOperator);
  if (!begun) return "was refused: " + begun.error();
  component::CommandHandle handle = std::move(begun).value();
  const RunEnd end = loop_.run_until(
      base::later(clock_.now(), options_.before_stop_limit),
      [&] { return handle.ended() || !health_.in_good_order(); }, stop);
  if (end == RunEnd::kStopRequested) {
    handle.cancel();
    return "was cut short by a signal";
  }
  if (!health_.in_good_order()) return "was ended by a fault";
  if (!handle.ended()) return "did not end within " + seconds(options_.before_stop_limit);
  if (handle.stage() == component::CommandStage::kDone) return {};
  return "was not done: " + std::string(handle.reason());
}

// ---- What is held

base::Diagnostics BeforeStop::hold_until_told(const platform::StopSignal* stop,
                                              const std::function<bool(base::Duration)>& converse) {
  base::Diagnostics diagnostics;
  if (health_.died()) return diagnostics;
  std::vector<Held> held = holders_.held();
  give_up_silent(held, diagnostics);
  if (held.empty()) return diagnostics;
  begin_to_leave();
  stop = heard(stop);
  say(held);
  const base::Time end = base::later(clock_.now(), options_.hold_at_stop);
  if (converse && converse(options_.hold_at_stop)) {
    name_let_go(holders_.held(), "it was told to", diagnostics);
    return diagnostics;
  }
  const RunEnd ended = wait_until_let_go(held, end, stop);
  if (ended == RunEnd::kConditionMet) return diagnostics;
  name_let_go(held, ended == RunEnd::kStopRequested ? "a signal came" : "no answer came",
              diagnostics);
  return diagnostics;
}

void BeforeStop::say(const std::vector<Held>& held) {
  for (const Held& one : held)
    outlets_.say("before the stop, " + quoted(one.component) + " holds " + one.what);
  outlets_.say("it is held for at most " + seconds(options_.hold_at_stop) +
               " while you do that; Ctrl-C again, or `quit` typed again, lets go of it");
}

/// @param held  what it was when it was last looked at
RunEnd BeforeStop::wait_until_let_go(std::vector<Held>& held, base::Time end,
                                     const platform::StopSignal* stop) {
  base::Time look = clock_.now();
  const auto let_go = [&] {
    if (clock_.now() < look) return false;
    look = base::later(clock_.now(), kLookPeriod);
    return (held = holders_.held()).empty();
  };
  return loop_.run_until(end, let_go, stop);
}

}  // namespace armature::exec::internal
