// SPDX-License-Identifier: Apache-2.0
#include "armature/component/component.hpp"

#include <utility>

#include "armature/component/input_port.hpp"
#include "armature/component/output_port.hpp"
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
  return refused(why);
}

Outcome Component::run_hook(Outcome (Component::*hook)()) {
  Outcome outcome = accepted();
  const bool completed = run(*context_, [&] { outcome = (this->*hook)(); });
  if (!completed) return refused(reason());
  reason_ = outcome.reason();
  return outcome;
}

Outcome Component::configure() {
  if (state() != State::kPreOperational) return wrong_state("configure");
  Outcome outcome = run_hook(&Component::on_configure);
  if (outcome) enter(State::kStopped);
  return outcome;
}

Outcome Component::activate() {
  if (state() != State::kStopped) return wrong_state("activate");
  return run_hook(&Component::on_activate);
}

Outcome Component::start() {
  if (state() != State::kStopped) return wrong_state("start");
  Outcome outcome = run_hook(&Component::on_start);
  if (!outcome) return outcome;
  aging_ = false;
  for (InputPortBase* input : interface_.inputs) {
    input->begin();
    if (input->max_age() > base::Duration::zero()) aging_ = true;
  }
  enter(State::kRunning);
  for (Step* step : steps_before_) run(*context_, [&] { step->start(); });
  return outcome;
}

void Component::stop() {
  if (state() != State::kRunning && state() != State::kRunTimeError) return;
  halt_steps("the component was stopped");
  enter(State::kStopped);
  run(*context_, [this] { on_stop(); });
}

void Component::cleanup() {
  if (state() != State::kStopped) return;
  enter(State::kPreOperational);
  run(*context_, [this] { on_cleanup(); });
}

Outcome Component::recover() {
  if (state() != State::kRunTimeError) return wrong_state("recover");
  reason_.clear();
  enter(State::kRunning);
  return accepted();
}

Outcome Component::reset() {
  if (state() != State::kException) return wrong_state("reset");
  Outcome outcome = run_hook(&Component::on_reset);
  if (outcome) enter(State::kStopped);
  return outcome;
}

void Component::update() {
  const State now = state();
  if (now == State::kRunTimeError) {
    run(*context_, [this] { on_error(); });
    return;
  }
  if (!admits()) return;
  run(*context_, [this] {
    for (Step* step : steps_before_) step->step();
    on_update();
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
  if (state() == State::kException) return;
  reason_ = reason;
  const bool was_running = state() == State::kRunning || state() == State::kRunTimeError;
  enter(State::kException);
  halt_steps(reason);
  log_error("fault: {}", reason);
  if (was_running) tell_readers_lost();
  if (was_running && context_->supervisor != nullptr) {
    context_->supervisor->component_faulted(*this);
  }
}

void Component::stop_because(std::string_view reason) {
  if (state() != State::kRunning && state() != State::kRunTimeError) return;
  const Reason kept(reason);
  stop();
  reason_ = kept;
  log_warning("stopped: {}", kept.view());
  tell_readers_lost();
  if (context_->supervisor != nullptr) context_->supervisor->component_stopped_itself(*this);
}

void Component::contain(const std::exception_ptr& exception) noexcept {
  const rt::PermitScope permit;
  try {
    std::rethrow_exception(exception);
  } catch (const std::exception& known) {
    fault(Reason("exception: ").append(known.what()).view());
  } catch (...) {
    fault("exception of an unknown type");
  }
}

void Component::check_ages() {
  for (InputPortBase* input : interface_.inputs) input->check_age();
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

void Component::take_time(ExecutionContext& where) {
  const std::uint64_t now = rt::ticks();
  if (Component* const last = where.running; last != nullptr) {
    last->measured_ticks_ += now - where.mark;
    last->measured_ = true;
  }
  where.mark = now;
}

void Component::close_measurement() {
  if (!measured_) return;
  execution_ticks_.add(measured_ticks_);
  measured_ticks_ = 0;
  measured_ = false;
}

void Component::log(rt::LogLevel level, const char* format, const LogArguments& arguments) {
  rt::LogRecord record;
  record.level = level;
  record.time = time();
  record.component = name_;
  record.format = format;
  record.arguments = arguments;
  if (context_->log != nullptr) context_->log->push(record);
}

}  // namespace armature::component
