// SPDX-License-Identifier: Apache-2.0
#include "armature/component/component.hpp"

#include <utility>

#include "armature/component/black_box.hpp"
#include "armature/component/host.hpp"
#include "armature/component/internal/component_rest.hpp"
#include "armature/rt/guard.hpp"
#include "armature/rt/log.hpp"

namespace armature::component {
namespace {

using Noted = BlackBox::Note::Kind;

/// Of the engine that works in the calling thread, nullptr if none does.
const ExecutionContext* context_of_this_thread() {
  return static_cast<const ExecutionContext*>(rt::guard_state().context);
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
    : context_(&internal::Inside::no_context()),
      rest_(std::make_unique<Rest>(*this, std::move(name))) {}

Component::~Component() = default;

const std::string& Component::name() const { return rest_->name; }

bool Component::is_configured() const { return rest_->configured; }

std::string_view Component::reason() const { return rest_->reason.view(); }

const Pace& Component::pace() const { return rest_->pace; }

base::Duration Component::period() const {
  return rest_->pace.known() ? rest_->pace.period : base::Duration::zero();
}

void Component::on_check(Check&) const {}

void Component::error(std::string_view reason) {
  if (state() != State::kRunning) return;
  rest_->reason = reason;
  internal::Inside::enter(*this, State::kRunTimeError);
  note(*this, Noted::kError, {}, reason);
  log_warning("{}", reason);
}

void Component::fault(std::string_view reason) {
  const ExecutionContext* const here = context_of_this_thread();
  if (here == nullptr) {
    internal::Inside::enter_fault(*this, reason);
  } else {
    internal::Inside::fault_from(*this, *here, reason);
  }
}

void Component::stop_because(std::string_view reason) {
  if (state() != State::kRunning && state() != State::kRunTimeError) return;
  const Reason kept(reason);
  Host::stop(*this);
  if (state() != State::kException) rest_->reason = kept;
  note(*this, Noted::kReaction, {}, kept);
  log_warning("stopped: {}", kept.view());
  if (context_->supervisor != nullptr) context_->supervisor->component_stopped_itself(*this);
  internal::Inside::tell_readers_lost(*this);
}

void Component::stop() { Host::stop(*this); }

Outcome Component::recover() { return Host::recover(*this); }

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
