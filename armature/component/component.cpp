// SPDX-License-Identifier: Apache-2.0
#include "armature/component/component.hpp"

#include <algorithm>
#include <utility>

#include "armature/component/input_port.hpp"
#include "armature/component/output_port.hpp"
#include "armature/component/state_machine.hpp"
#include "armature/rt/guard.hpp"

namespace armature::component {
namespace {

/// Where a component lives before an application gave it a thread.
ExecutionContext& no_context() {
  static ExecutionContext context("none");
  return context;
}

}  // namespace

std::string_view name_of(State state) {
  switch (state) {
    case State::kPreOperational:
      return "PreOperational";
    case State::kException:
      return "Exception";
    case State::kStopped:
      return "Stopped";
    case State::kRunning:
      return "Running";
    case State::kRunTimeError:
      return "RunTimeError";
  }
  return "unknown";
}

Component::Component(std::string name) : name_(std::move(name)), context_(&no_context()) {}

Component::~Component() = default;

Outcome Component::wrong_state(std::string_view transition) const {
  Reason why("cannot ");
  why.append(transition).append(" while ").append(name_of(state()));
  if (!reason_.empty()) why.append(": ").append(reason_);
  return refused(why);
}

void Component::assign_context(ExecutionContext& context) {
  context_ = &context;
  reported_fault_.lower();
  for (InputPortBase* input : interface_.inputs) input->forget_messages();
}

/// Runs a hook that may refuse, and enters `next` if it neither did nor faulted.
Outcome Component::run_hook(Outcome (Component::*hook)(), State next) {
  const State before = state();
  reason_.clear();
  Outcome outcome = accepted();
  const bool completed = run(*context_, [&] { outcome = (this->*hook)(); });
  const bool faulted = !completed || state() != before || !reason_.empty();
  if (faulted) return refused(reason_);
  if (!outcome) {
    reason_ = outcome.reason();
  } else {
    enter(next);
  }
  return outcome;
}

Outcome Component::configure() {
  if (state() != State::kPreOperational) return wrong_state("configure");
  for (const StateMachine* machine : interface_.machines) {
    if (machine->problems().empty()) continue;
    reason_ = Reason("state machine '").append(machine->name()).append("': ");
    return refused(reason_.append(machine->problems().front()));
  }
  Outcome outcome = run_hook(&Component::on_configure, State::kStopped);
  configured_ = outcome.ok();
  return outcome;
}

Outcome Component::activate() {
  if (state() != State::kStopped) return wrong_state("activate");
  return run_hook(&Component::on_activate, State::kStopped);
}

Outcome Component::start() {
  if (state() != State::kStopped) return wrong_state("start");
  aging_ = false;
  checked_at_ = time();
  for (InputPortBase* input : interface_.inputs) {
    input->begin();
    if (input->max_age() > base::Duration::zero()) aging_ = true;
  }
  Outcome outcome = run_hook(&Component::on_start, State::kRunning);
  if (!outcome) return outcome;
  for (Step* step : steps_before_) {
    if (state() == State::kRunning) run(*context_, [&] { step->start(); });
  }
  return state() == State::kException ? refused(reason()) : outcome;
}

void Component::stop() {
  if (state() != State::kRunning && state() != State::kRunTimeError) return;
  enter(State::kStopped);
  halt_steps("the component was stopped");
  run(*context_, [this] { on_stop(); });
}

void Component::cleanup() {
  if (state() == State::kStopped) retire();
}

void Component::retire() {
  if (state() != State::kStopped && state() != State::kException) return;
  enter(State::kPreOperational);
  if (std::exchange(configured_, false)) run(*context_, [this] { on_cleanup(); });
}

Outcome Component::recover() {
  if (state() != State::kRunTimeError) return wrong_state("recover");
  reason_.clear();
  enter(State::kRunning);
  return accepted();
}

Outcome Component::reset() {
  if (state() != State::kException) return wrong_state("reset");
  return run_hook(&Component::on_reset, configured_ ? State::kStopped : State::kPreOperational);
}

void Component::update() {
  if (state() == State::kRunTimeError) {
    run(*context_, [this] { on_error(); });
    return;
  }
  if (!admits()) return;
  run(*context_, [this] {
    for (Step* step : steps_before_) step->step();
    if (state() == State::kRunning) on_update();
    for (Step* step : steps_after_) step->step();
  });
}

void Component::error(std::string_view reason) {
  if (state() != State::kRunning) return;
  reason_ = reason;
  enter(State::kRunTimeError);
  log_warning("{}", reason);
}

void Component::fault(std::string_view reason) {
  const State before = state();
  if (before == State::kException) {
    if (reason_.empty()) reason_ = reason;
    return;
  }
  reason_ = reason;
  enter(State::kException);
  halt_steps(reason_);
  log_error("fault: {}", reason_.view());
  if (before == State::kRunning || before == State::kRunTimeError) tell_readers_lost();
  if (context_->supervisor != nullptr) context_->supervisor->component_faulted(*this);
}

void Component::stop_because(std::string_view reason) {
  if (state() != State::kRunning && state() != State::kRunTimeError) return;
  const Reason kept(reason);
  stop();
  if (state() != State::kException) reason_ = kept;
  log_warning("stopped: {}", kept.view());
  tell_readers_lost();
  if (context_->supervisor != nullptr) context_->supervisor->component_stopped_itself(*this);
}

void Component::contain(const std::exception_ptr& exception, ExecutionContext& where) noexcept {
  const rt::PermitScope permit;
  try {
    std::rethrow_exception(exception);
  } catch (const std::exception& known) {
    fault_from(where, Reason("exception: ").append(known.what()));
  } catch (...) {
    fault_from(where, "exception of an unknown type");
  }
}

void Component::refuse_depth(ExecutionContext& where) noexcept {
  Reason why("handlers and operations nest too deeply in thread '");
  fault_from(where, why.append(where.name).append("': do they call each other without end?"));
}

/// Faults at once in the component's own thread, else by a message to it: its state, its commands
/// and its log belong to that thread.
void Component::fault_from(ExecutionContext& where, std::string_view reason) {
  if (context_->shares_thread_with(where)) {
    fault(reason);
  } else if (!reported_fault_.taken.exchange(true, std::memory_order_acquire)) {
    reported_fault_.reason = reason;
    context_->raise(reported_fault_);
  }
}

void Component::ReportedFault::deliver(rt::Message& message) {
  auto& report = static_cast<ReportedFault&>(message);
  report.lower();
  report.self.fault(report.reason);
  report.taken.store(false, std::memory_order_release);
}

void Component::check_ages() {
  checked_at_ = time();
  for (InputPortBase* input : interface_.inputs) input->check_age();
}

base::Time Component::next_expiry() const {
  base::Time earliest = base::Time::max();
  if (!aging_ || state() != State::kRunning) return earliest;
  for (const InputPortBase* input : interface_.inputs) {
    earliest = std::min(earliest, input->expiry());
  }
  return earliest;
}

void Component::tell_readers_lost() {
  for (OutputPortBase* output : interface_.outputs) {
    for (InputPortBase* reader : output->readers()) {
      if (&reader->owner() != this) reader->tell_lost();
    }
  }
}

void Component::halt_steps(std::string_view why) {
  for (Step* step : steps_before_) step->halt(why);
  for (Step* step : steps_after_) step->halt(why);
}

void Component::add_step(Step& step, bool before_update) {
  (before_update ? steps_before_ : steps_after_).push_back(&step);
}

void Component::remove_step(Step& step) {
  std::erase(steps_before_, &step);
  std::erase(steps_after_, &step);
}

void Component::take_time(ExecutionContext& where) {
  const std::uint64_t now = rt::ticks();
  // What runs here as a guest keeps its measurements in its own thread.
  Component* const last = where.running.load(std::memory_order_relaxed);
  if (last != nullptr && last->context_ == &where) {
    last->measured_ticks_ += now - where.mark;
    if (!std::exchange(last->measured_, true)) {
      last->next_measured_ = std::exchange(where.measured, last);
    }
  }
  where.mark = now;
}

void Component::close_measurements(ExecutionContext& where) {
  for (Component* each = std::exchange(where.measured, nullptr); each != nullptr;
       each = std::exchange(each->next_measured_, nullptr)) {
    each->execution_ticks_.add(std::exchange(each->measured_ticks_, 0));
    each->measured_ = false;
  }
}

void Component::log(rt::LogLevel level, const char* format, const LogArguments& arguments) {
  rt::LogRecord record;
  record.level = level;
  record.time = time();
  record.component = name_;
  record.format = format;
  record.arguments = arguments;
  const auto* here = static_cast<const ExecutionContext*>(rt::guard_state().context);
  rt::LogQueue* const queue = here != nullptr ? here->log : context_->log;
  if (queue != nullptr) queue->push(record);
}

}  // namespace armature::component
