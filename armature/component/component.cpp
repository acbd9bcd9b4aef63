// SPDX-License-Identifier: Apache-2.0
#include "armature/component/component.hpp"

#include <algorithm>
#include <exception>
#include <utility>

#include "armature/component/black_box.hpp"
#include "armature/component/internal/component_rest.hpp"
#include "armature/component/lanes.hpp"
#include "armature/component/ports/input_port.hpp"
#include "armature/component/ports/output_port.hpp"
#include "armature/component/states/state_machine.hpp"
#include "armature/component/timeline.hpp"
#include "armature/rt/guard.hpp"
#include "armature/rt/log.hpp"
#include "armature/rt/ticks.hpp"

namespace armature::component {
namespace {

using Noted = BlackBox::Note::Kind;

/// Where a component lives before an application gave it a thread.
ExecutionContext& no_context() {
  static ExecutionContext context("none");
  return context;
}

/// Of the engine that works in the calling thread, nullptr if none does.
const ExecutionContext* context_of_this_thread() {
  return static_cast<const ExecutionContext*>(rt::guard_state().context);
}

constexpr std::string_view kExceptionBegin = "exception: ";

/// What of an exception is longer than a reason.
std::string_view rest_of(std::string_view what) {
  const Reason told = Reason(kExceptionBegin).append(what);
  what.remove_prefix(told.view().size() - kExceptionBegin.size());
  return what;
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

Component::Component(std::string name)
    : context_(&no_context()), rest_(std::make_unique<Rest>(*this, std::move(name))) {}

Component::~Component() = default;

const std::string& Component::name() const { return rest_->name; }

bool Component::is_configured() const { return rest_->configured; }

std::string_view Component::reason() const { return rest_->reason.view(); }

const Pace& Component::pace() const { return rest_->pace; }

base::Duration Component::period() const {
  return rest_->pace.known() ? rest_->pace.period : base::Duration::zero();
}

void Component::set_pace(const Pace& pace) {
  if (rest_->pace != pace) rest_->pace = pace;
}

const Interface& Component::interface() const { return rest_->interface; }

Interface& Component::declare() { return rest_->interface; }

const rt::Distribution& Component::execution_ticks() const { return rest_->execution_ticks; }

void Component::on_check(Check&) const {}

Outcome Component::wrong_state(std::string_view transition) const {
  Reason why("cannot ");
  why.append(transition).append(" while ").append(name_of(state()));
  if (!rest_->reason.empty()) why.append(": ").append(rest_->reason);
  return refused(why);
}

void Component::assign_context(ExecutionContext& context) {
  const bool is_first = std::exchange(context_, &context) == &no_context();
  if (is_first) return;  // nothing was on its way
  rest_->reported_fault.lower();
  rest_->reported_fault.taken = false;
  for (InputPortBase* input : rest_->interface.inputs) input->forget_messages();
}

/// Runs a hook that may refuse, and enters `next` if it neither did nor faulted.
Outcome Component::run_hook(Outcome (Component::*hook)(), State next) {
  const State before = state();
  rest_->reason.clear();
  Outcome outcome = accepted();
  const bool completed = run(*context_, [&] { outcome = (this->*hook)(); });
  const bool faulted = !completed || state() != before || !rest_->reason.empty();
  if (faulted) return refused(rest_->reason);
  if (!outcome) {
    rest_->reason = outcome.reason();
  } else {
    enter(next);
  }
  return outcome;
}

Outcome Component::configure() {
  if (state() != State::kPreOperational) return wrong_state("configure");
  for (const StateMachine* machine : rest_->interface.machines) {
    if (machine->problems().empty()) continue;
    rest_->reason = Reason("state machine '").append(machine->name()).append("': ");
    return refused(rest_->reason.append(machine->problems().front()));
  }
  Outcome outcome = run_hook(&Component::on_configure, State::kStopped);
  rest_->configured = outcome.ok();
  return outcome;
}

Outcome Component::activate() {
  if (state() != State::kStopped) return wrong_state("activate");
  return run_hook(&Component::on_activate, State::kStopped);
}

Outcome Component::start() {
  if (state() != State::kStopped) return wrong_state("start");
  aging_ = false;
  rest_->ages_hold_until = time();
  for (InputPortBase* input : rest_->interface.inputs) {
    input->begin();
    if (input->ages()) aging_ = true;
  }
  Outcome outcome = run_hook(&Component::on_start, State::kRunning);
  if (!outcome) return outcome;
  for (Step* step : rest_->steps_before) {
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
  if (std::exchange(rest_->configured, false)) run(*context_, [this] { on_cleanup(); });
}

Outcome Component::recover() {
  if (state() != State::kRunTimeError) return wrong_state("recover");
  rest_->reason.clear();
  enter(State::kRunning);
  return accepted();
}

Outcome Component::reset() {
  if (state() != State::kException) return wrong_state("reset");
  Outcome outcome =
      run_hook(&Component::on_reset, rest_->configured ? State::kStopped : State::kPreOperational);
  if (outcome) log_info("reset");
  return outcome;
}

void Component::update() {
  if (state() == State::kRunTimeError) {
    run(*context_, [this] { on_error(); });
    return;
  }
  if (!admits()) return;
  if (context_->outbox.any()) [[unlikely]]
    context_->outbox.flush();  // an update may take its time: nobody waits for it
  run_handler(*context_, [this] {
    for (Step* step : rest_->steps_before) step->step();
    if (state() == State::kRunning) on_update();
    for (Step* step : rest_->steps_after) step->step();
  });
}

void Component::error(std::string_view reason) {
  if (state() != State::kRunning) return;
  rest_->reason = reason;
  enter(State::kRunTimeError);
  note(*this, Noted::kError, {}, reason);
  log_warning("{}", reason);
}

void Component::fault(std::string_view reason) {
  const ExecutionContext* const here = context_of_this_thread();
  if (here == nullptr) {
    enter_fault(reason);
  } else {
    fault_from(*here, reason);
  }
}

void Component::enter_fault(std::string_view reason) {
  const State before = state();
  if (before == State::kException) {
    if (rest_->reason.empty()) rest_->reason = reason;
    return;
  }
  rest_->reason = reason;
  enter(State::kException);
  note(*this, Noted::kFault, {}, rest_->reason);
  halt_steps(rest_->reason);
  log_error("fault: {}", rest_->reason.view());
  if (context_->supervisor != nullptr) context_->supervisor->component_faulted(*this);
  if (before == State::kRunning || before == State::kRunTimeError) tell_readers_lost();
}

void Component::stop_because(std::string_view reason) {
  if (state() != State::kRunning && state() != State::kRunTimeError) return;
  const Reason kept(reason);
  stop();
  if (state() != State::kException) rest_->reason = kept;
  note(*this, Noted::kReaction, {}, kept);
  log_warning("stopped: {}", kept.view());
  if (context_->supervisor != nullptr) context_->supervisor->component_stopped_itself(*this);
  tell_readers_lost();
}

void Component::contain(ExecutionContext& where) noexcept {
  const rt::PermitScope permit;
  where.caught = std::current_exception();
  try {
    throw;
  } catch (const std::exception& known) {
    fault_from(where, Reason(kExceptionBegin).append(known.what()));
    for (std::string_view rest = rest_of(known.what()); !rest.empty();) {
      const std::string_view line = rest.substr(0, rt::LogRecord::kTextRoom);
      log_error("rest of the exception: {}", line);
      rest.remove_prefix(line.size());
    }
  } catch (...) {
    fault_from(where, "exception of an unknown type");
  }
}

void Component::refuse_depth(ExecutionContext& where) noexcept {
  Reason why("handlers and operations nest too deeply in the thread '");
  fault_from(where, why.append(where.name).append("': look for calls that go in a circle"));
}

/// Faults at once in the component's own thread, else by a message to it: its state, its commands
/// and its log belong to that thread.
void Component::fault_from(const ExecutionContext& where, std::string_view reason) {
  if (context_->shares_thread_with(where)) {
    enter_fault(reason);
  } else if (!rest_->reported_fault.taken.exchange(true, std::memory_order_acquire)) {
    rest_->reported_fault.reason = reason;
    context_->raise(rest_->reported_fault);
  }
}

void Component::ReportedFault::deliver(rt::Message& message) {
  auto& report = static_cast<ReportedFault&>(message);
  report.lower();
  report.self.enter_fault(report.reason);
  report.taken.store(false, std::memory_order_release);
}

void Component::enter(State state) {
  state_.store(state, std::memory_order_release);
  set_at_once(state == State::kRunning && !aging_);
  if (aging_) context_->ages_to_settle = true;
  note(*this, Noted::kState, {}, name_of(state));
}

void Component::set_at_once(bool on) {
  if (on == admits_at_once_) return;
  admits_at_once_ = on;
  for (InputPortBase* input : rest_->interface.inputs) input->set_at_once(on);
}

bool Component::admits_after_look() noexcept {
  if (aging_ && time() > rest_->ages_hold_until) check_ages();
  return state() == State::kRunning;
}

void Component::note_aging_input() {
  aging_ = true;
  rest_->ages_hold_until = {};
  set_at_once(false);
  context_->ages_to_settle = true;
}

base::Time Component::settle_ages() {
  if (state() != State::kRunning) return base::Time::max();
  base::Time hold = base::Time::max();
  for (const InputPortBase* input : rest_->interface.inputs) {
    hold = std::min(hold, input->age_holds_until());
  }
  set_at_once(hold >= time());
  if (admits_at_once_) rest_->ages_hold_until = hold;
  return hold;
}

void Component::check_ages() {
  base::Time hold = base::Time::max();
  for (InputPortBase* input : rest_->interface.inputs) {
    input->check_age();
    hold = std::min(hold, input->age_holds_until());
  }
  rest_->ages_hold_until = std::max(hold, time());
}

base::Time Component::next_expiry() const {
  base::Time earliest = base::Time::max();
  if (!aging_ || state() != State::kRunning) return earliest;
  for (const InputPortBase* input : rest_->interface.inputs) {
    earliest = std::min(earliest, input->expiry());
  }
  return earliest;
}

void Component::tell_readers_lost() {
  for (OutputPortBase* output : rest_->interface.outputs) {
    for (InputPortBase* reader : output->readers()) {
      if (&reader->owner() != this) reader->tell_lost();
    }
  }
}

void Component::halt_steps(std::string_view why) {
  for (Step* step : rest_->steps_before) step->halt(why);
  for (Step* step : rest_->steps_after) step->halt(why);
}

void Component::add_step(Step& step, bool before_update) {
  (before_update ? rest_->steps_before : rest_->steps_after).push_back(&step);
}

void Component::remove_step(Step& step) {
  std::erase(rest_->steps_before, &step);
  std::erase(rest_->steps_after, &step);
}

void Component::charge(ExecutionContext& where, Component* ran) noexcept {
  const std::uint64_t now = rt::ticks();
  if (where.timeline != nullptr) where.timeline->add_step(ran, where.mark, now);
  // What runs here as a guest keeps its measurements in its own thread.
  if (ran != nullptr && ran->context_ == &where) {
    Rest& rest = *ran->rest_;
    rest.measured_ticks += now - where.mark;
    if (!std::exchange(rest.measured, true)) {
      rest.next_measured = std::exchange(where.measured, ran);
    }
  }
  where.mark = now;
}

void Component::close_measurements(ExecutionContext& where) {
  for (Component* each = std::exchange(where.measured, nullptr); each != nullptr;) {
    Rest& rest = *each->rest_;
    rest.execution_ticks.add(std::exchange(rest.measured_ticks, 0));
    rest.measured = false;
    each = std::exchange(rest.next_measured, nullptr);
  }
}

void Component::log(rt::LogLevel level, const char* format, const LogArguments& arguments) {
  rt::LogRecord record;
  record.level = level;
  record.time = time();
  record.component = rest_->name;
  record.format = format;
  record.take(arguments);
  const ExecutionContext* const here = context_of_this_thread();
  rt::LogQueue* const queue = here != nullptr ? here->log : context_->log;
  if (queue != nullptr) queue->push(record);
}

}  // namespace armature::component
