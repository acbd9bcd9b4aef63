// SPDX-License-Identifier: Apache-2.0
#include "armature/component/host.hpp"

#include <algorithm>
#include <utility>

#include "armature/component/internal/component_rest.hpp"
#include "armature/component/lanes.hpp"
#include "armature/component/ports/input_port.hpp"
#include "armature/component/states/state_machine.hpp"
#include "armature/rt/log.hpp"

namespace armature::component {

const Interface& interface_of(const Component& component) { return component.rest_->interface; }

Interface& Host::declare(Component& component) { return component.rest_->interface; }

const rt::Distribution& Host::execution_ticks(const Component& component) {
  return component.rest_->execution_ticks;
}

void Host::assign_context(Component& component, ExecutionContext& context) {
  const bool is_first = std::exchange(component.context_, &context) == &no_context();
  if (is_first) return;  // nothing was on its way
  component.rest_->reported_fault.lower();
  component.rest_->reported_fault.taken = false;
  for (InputPortBase* input : component.rest_->interface.inputs) input->forget_messages();
}

Outcome Host::run_hook(Component& component, Hook hook, State next) {
  const State before = component.state();
  component.rest_->reason.clear();
  Outcome outcome = accepted();
  const bool completed =
      run(component, *component.context_, [&] { outcome = (component.*hook)(); });
  const bool faulted =
      !completed || component.state() != before || !component.rest_->reason.empty();
  if (faulted) return refused(component.rest_->reason);
  if (!outcome) {
    component.rest_->reason = outcome.reason();
  } else {
    enter(component, next);
  }
  return outcome;
}

Outcome Host::configure(Component& component) {
  if (component.state() != State::kPreOperational) return wrong_state(component, "configure");
  for (const StateMachine* machine : component.rest_->interface.machines) {
    if (machine->problems().empty()) continue;
    component.rest_->reason = Reason("state machine '").append(machine->name()).append("': ");
    return refused(component.rest_->reason.append(machine->problems().front()));
  }
  Outcome outcome = run_hook(component, &Component::on_configure, State::kStopped);
  component.rest_->configured = outcome.ok();
  return outcome;
}

Outcome Host::activate(Component& component) {
  if (component.state() != State::kStopped) return wrong_state(component, "activate");
  return run_hook(component, &Component::on_activate, State::kStopped);
}

Outcome Host::start(Component& component) {
  if (component.state() != State::kStopped) return wrong_state(component, "start");
  component.aging_ = false;
  component.rest_->ages_hold_until = component.time();
  for (InputPortBase* input : component.rest_->interface.inputs) {
    input->begin();
    if (input->ages()) component.aging_ = true;
  }
  Outcome outcome = run_hook(component, &Component::on_start, State::kRunning);
  if (!outcome) return outcome;
  for (Step* step : component.rest_->steps_before) {
    if (component.state() == State::kRunning)
      run(component, *component.context_, [&] { step->start(); });
  }
  return component.state() == State::kException ? refused(component.reason()) : outcome;
}

void Host::stop(Component& component) {
  if (component.state() != State::kRunning && component.state() != State::kRunTimeError) return;
  enter(component, State::kStopped);
  halt_steps(component, "the component was stopped");
  run(component, *component.context_, [&component] { component.on_stop(); });
}

void Host::cleanup(Component& component) {
  if (component.state() == State::kStopped) retire(component);
}

void Host::retire(Component& component) {
  if (component.state() != State::kStopped && component.state() != State::kException) return;
  enter(component, State::kPreOperational);
  if (std::exchange(component.rest_->configured, false))
    run(component, *component.context_, [&component] { component.on_cleanup(); });
}

Outcome Host::recover(Component& component) {
  if (component.state() != State::kRunTimeError) return wrong_state(component, "recover");
  component.rest_->reason.clear();
  enter(component, State::kRunning);
  return accepted();
}

Outcome Host::reset(Component& component) {
  if (component.state() != State::kException) return wrong_state(component, "reset");
  Outcome outcome =
      run_hook(component, &Component::on_reset,
               component.rest_->configured ? State::kStopped : State::kPreOperational);
  if (outcome) component.log_info("reset");
  return outcome;
}

void Host::update(Component& component) {
  if (component.state() == State::kRunTimeError) {
    run(component, *component.context_, [&component] { component.on_error(); });
    return;
  }
  if (!admits(component)) return;
  if (component.context_->outbox.any()) [[unlikely]]
    component.context_->outbox.flush();  // an update may take its time: nobody waits for it
  run_handler(component, *component.context_, [&component] {
    for (Step* step : component.rest_->steps_before) step->step();
    if (component.state() == State::kRunning) component.on_update();
    for (Step* step : component.rest_->steps_after) step->step();
  });
}

void Host::note_aging_input(Component& component) {
  component.aging_ = true;
  component.rest_->ages_hold_until = {};
  set_at_once(component, false);
  component.context_->ages_to_settle = true;
}

base::Time Host::settle_ages(Component& component) {
  if (component.state() != State::kRunning) return base::Time::max();
  base::Time hold = base::Time::max();
  for (const InputPortBase* input : component.rest_->interface.inputs) {
    hold = std::min(hold, input->age_holds_until());
  }
  set_at_once(component, hold >= component.time());
  if (component.admits_at_once_) component.rest_->ages_hold_until = hold;
  return hold;
}

base::Time Host::next_expiry(const Component& component) {
  base::Time earliest = base::Time::max();
  if (!component.aging_ || component.state() != State::kRunning) return earliest;
  for (const InputPortBase* input : component.rest_->interface.inputs) {
    earliest = std::min(earliest, input->expiry());
  }
  return earliest;
}

void Host::add_step(Component& component, Step& step, bool before_update) {
  (before_update ? component.rest_->steps_before : component.rest_->steps_after).push_back(&step);
}

void Host::remove_step(Component& component, Step& step) {
  std::erase(component.rest_->steps_before, &step);
  std::erase(component.rest_->steps_after, &step);
}

Outcome Host::wrong_state(const Component& component, std::string_view transition) {
  Reason why("cannot ");
  why.append(transition).append(" while ").append(name_of(component.state()));
  if (!component.rest_->reason.empty()) why.append(": ").append(component.rest_->reason);
  return refused(why);
}

void Host::set_pace(Component& component, const Pace& pace) {
  if (component.rest_->pace != pace) component.rest_->pace = pace;
}

void Host::close_measurements(ExecutionContext& where) {
  for (Component* each = std::exchange(where.measured, nullptr); each != nullptr;) {
    Component::Rest& rest = *each->rest_;
    rest.execution_ticks.add(std::exchange(rest.measured_ticks, 0));
    rest.measured = false;
    each = std::exchange(rest.next_measured, nullptr);
  }
}

}  // namespace armature::component
