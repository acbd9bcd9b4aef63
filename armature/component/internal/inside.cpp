// SPDX-License-Identifier: Apache-2.0
#include "armature/component/internal/inside.hpp"

#include <algorithm>
#include <exception>
#include <utility>

#include "armature/component/black_box.hpp"
#include "armature/component/internal/component_rest.hpp"
#include "armature/component/observing/cycle_record.hpp"
#include "armature/component/observing/timeline.hpp"
#include "armature/component/ports/input_port.hpp"
#include "armature/component/ports/output_port.hpp"
#include "armature/rt/guard.hpp"
#include "armature/rt/log.hpp"
#include "armature/rt/ticks.hpp"

namespace armature::component::internal {
namespace {

using Noted = BlackBox::Note::Kind;

constexpr std::string_view kExceptionBegin = "exception: ";

/// What of an exception is longer than a reason.
std::string_view rest_of(std::string_view what) {
  const Reason told = Reason(kExceptionBegin).append(what);
  what.remove_prefix(told.view().size() - kExceptionBegin.size());
  return what;
}

}  // namespace

ExecutionContext& Inside::no_context() {
  static ExecutionContext context("none");
  return context;
}

void Inside::enter_fault(Component& component, std::string_view reason) {
  const State before = component.state();
  if (before == State::kException) {
    if (component.rest_->reason.empty()) component.rest_->reason = reason;
    return;
  }
  component.rest_->reason = reason;
  enter(component, State::kException);
  note(component, Noted::kFault, {}, component.rest_->reason);
  halt_steps(component, component.rest_->reason);
  component.log_error("fault: {}", component.rest_->reason.view());
  if (component.context_->supervisor != nullptr)
    component.context_->supervisor->component_faulted(component);
  if (before == State::kRunning || before == State::kRunTimeError) tell_readers_lost(component);
}

void Inside::contain(Component& component, ExecutionContext& where) noexcept {
  const rt::PermitScope permit;
  where.caught = std::current_exception();
  try {
    throw;
  } catch (const std::exception& known) {
    fault_from(component, where, Reason(kExceptionBegin).append(known.what()));
    for (std::string_view rest = rest_of(known.what()); !rest.empty();) {
      const std::string_view line = rest.substr(0, rt::LogRecord::kTextRoom);
      component.log_error("rest of the exception: {}", line);
      rest.remove_prefix(line.size());
    }
  } catch (...) {
    fault_from(component, where, "exception of an unknown type");
  }
}

void Inside::refuse_depth(Component& component, ExecutionContext& where) noexcept {
  Reason why("handlers and operations nest too deeply in the thread '");
  fault_from(component, where,
             why.append(where.name).append("': look for calls that go in a circle"));
}

void Inside::fault_from(Component& component, const ExecutionContext& where,
                        std::string_view reason) {
  if (component.context_->shares_thread_with(where)) {
    enter_fault(component, reason);
  } else if (!component.rest_->reported_fault.taken.exchange(true, std::memory_order_acquire)) {
    component.rest_->reported_fault.reason = reason;
    component.context_->raise(component.rest_->reported_fault);
  }
}

void Inside::enter(Component& component, State state) {
  component.state_.store(state, std::memory_order_release);
  set_at_once(component, state == State::kRunning && !component.aging_);
  if (component.aging_) component.context_->ages_to_settle = true;
  note(component, Noted::kState, {}, name_of(state));
}

void Inside::set_at_once(Component& component, bool on) {
  if (on == component.admits_at_once_) return;
  component.admits_at_once_ = on;
  for (InputPortBase* input : component.rest_->interface.inputs) input->set_at_once(on);
}

bool Inside::admits_after_look(Component& component) noexcept {
  if (component.aging_ && component.time() > component.rest_->ages_hold_until)
    check_ages(component);
  return component.state() == State::kRunning;
}

void Inside::check_ages(Component& component) {
  base::Time hold = base::Time::max();
  for (InputPortBase* input : component.rest_->interface.inputs) {
    input->check_age();
    hold = std::min(hold, input->age_holds_until());
  }
  component.rest_->ages_hold_until = std::max(hold, component.time());
}

void Inside::tell_readers_lost(Component& component) {
  for (OutputPortBase* output : component.rest_->interface.outputs) {
    for (InputPortBase* reader : output->readers()) {
      if (&reader->owner() != &component) reader->tell_lost();
    }
  }
}

void Inside::halt_steps(Component& component, std::string_view why) {
  for (Step* step : component.rest_->steps_before) step->halt(why);
  for (Step* step : component.rest_->steps_after) step->halt(why);
}

void Inside::charge(ExecutionContext& where, Component* ran) noexcept {
  const std::uint64_t now = rt::ticks();
  if (where.timeline != nullptr) where.timeline->add_step(ran, where.mark, now);
  if (where.record != nullptr) where.record->add_step(ran, where.mark, now);
  // What runs here as a guest keeps its measurements in its own thread.
  if (ran != nullptr && ran->context_ == &where) {
    Component::Rest& rest = *ran->rest_;
    rest.measured_ticks += now - where.mark;
    if (!std::exchange(rest.measured, true)) {
      rest.next_measured = std::exchange(where.measured, ran);
    }
  }
  where.mark = now;
}

void Inside::ReportedFault::deliver(rt::Message& message) {
  auto& report = static_cast<ReportedFault&>(message);
  report.lower();
  enter_fault(report.self, report.reason);
  report.taken.store(false, std::memory_order_release);
}

}  // namespace armature::component::internal
