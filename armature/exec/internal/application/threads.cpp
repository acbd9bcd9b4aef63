// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/internal/application/threads.hpp"

#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "armature/base/quoted.hpp"
#include "armature/platform/death_watch.hpp"
#include "armature/platform/memory.hpp"
#include "armature/platform/stop_priority.hpp"

namespace armature::exec::internal {
namespace {

using base::quoted;

/// Room for the components' own variables, and for handlers that set each other off within one
/// thread.
std::size_t stack_for(const ThreadPlan& plan) {
  constexpr std::size_t kBase = 256 * 1024;
  constexpr std::size_t kEachHandler = 2 * 1024;
  const auto depth = static_cast<std::size_t>(plan.depth);
  return kBase + depth * kEachHandler;
}

platform::ThreadRequest request_for(const ThreadPlan& plan, RealtimeMode mode) {
  platform::ThreadRequest request;
  request.name = plan.name;
  request.stack_bytes = stack_for(plan);
  request.prefault = mode != RealtimeMode::kOff;
  if (mode == RealtimeMode::kOff) return request;
  const Activity& activity = plan.activity;
  request.cpus = activity.cpus;
  request.priority = activity.priority;
  request.period = activity.period;
  request.runtime = activity.budget;
  if (activity.scheduler == Activity::Scheduler::kRealtime) {
    request.scheduler = platform::Scheduler::kFifo;
  } else if (activity.scheduler == Activity::Scheduler::kDeadline) {
    request.scheduler = platform::Scheduler::kDeadline;
  }
  return request;
}

std::string scheduling_text(platform::Scheduler scheduler, int priority,
                            const std::vector<int>& cpus) {
  std::string text = "the ordinary scheduler";
  if (scheduler == platform::Scheduler::kFifo) {
    text = "SCHED_FIFO priority " + std::to_string(priority);
  }
  if (scheduler == platform::Scheduler::kDeadline) text = "SCHED_DEADLINE";
  for (std::size_t i = 0; i < cpus.size(); ++i) {
    text += (i == 0 ? " on CPU " : ", ") + std::to_string(cpus[i]);
  }
  return text;
}

Verdict::Line line_of(const platform::ThreadRequest& request, const platform::ThreadGrant& grant) {
  return {request.name, scheduling_text(request.scheduler, request.priority, request.cpus),
          scheduling_text(grant.scheduler, grant.priority, grant.cpus), grant.refusals};
}

}  // namespace

bool Threads::prepare(base::Diagnostics& diagnostics) {
  verdict_ = {};
  if (options_.simulated) return true;
  if (options_.realtime != RealtimeMode::kOff) reserve_system();
  gate_ = std::make_shared<StartGate>();
  try {
    start_workers();
  } catch (const std::system_error& problem) {
    diagnostics.error({}, problem.what());
    return false;
  }
  if (options_.realtime != RealtimeMode::kRequire || verdict_.complete()) return true;
  diagnostics.error({}, "real time is required but not available:\n" + verdict_.to_text());
  return false;
}

void Threads::start_workers() {
  for (Index t = 0; t < engines_.size(); ++t) {
    const bool idle = plan_.threads[t].members.empty() && t == plan_.service_thread();
    if (!idle) start_worker(t);
  }
  age_watch_ = std::make_unique<AgeWatch>(engines_, options_.realtime != RealtimeMode::kOff);
  if (const platform::ThreadGrant* grant = age_watch_->grant()) {
    verdict_.lines.push_back(line_of(age_watch_->request(), *grant));
  }
}

void Threads::reserve_system() {
  const base::Result<void> locked = platform::lock_memory();
  memory_locked_ = locked.ok();
  Verdict::Line memory{"memory", "locked", memory_locked_ ? "locked" : "not locked", {}};
  if (!locked) memory.refusals.push_back(locked.error());
  verdict_.lines.push_back(std::move(memory));

  base::Result<platform::IdleStateHold> held = platform::IdleStateHold::take();
  Verdict::Line idle{"idle states", "held off", held.ok() ? "held off" : "left to the system", {}};
  if (held.ok()) {
    idle_states_ = std::move(held).value();
  } else {
    idle.refusals.push_back(held.error());
  }
  verdict_.lines.push_back(std::move(idle));
  verdict_.lines.push_back(kernel_line());
  verdict_.lines.push_back(clock_line());
}

void Threads::start_worker(Index thread) {
  const ThreadPlan& plan = plan_.threads[thread];
  Engine* const engine = engines_[thread].get();
  const platform::ThreadRequest request = request_for(plan, options_.realtime);
  workers_.push_back({engine, std::make_unique<platform::Thread>(request, [gate = gate_, engine] {
                        if (gate->wait(&engine->context(), platform::thread_number())) {
                          engine->serve();
                        }
                      })});
  verdict_.lines.push_back(line_of(request, workers_.back().thread->grant()));
}

void Threads::populate_memory() const {
  if (memory_locked_) platform::populate_memory();
}

void Threads::go() {
  if (gate_ != nullptr) gate_->open();
}

void Threads::make_prompt(const component::ExecutionContext& context) const {
  if (gate_ == nullptr || options_.realtime == RealtimeMode::kOff) return;
  platform::make_prompt(gate_->thread_of(&context));
}

void Threads::end(base::Diagnostics& diagnostics) {
  if (gate_ != nullptr) gate_->give_up();
  for (const auto& engine : engines_) engine->end();
  std::vector<component::ExecutionContext*> ended;
  for (Worker& worker : workers_) {
    if (join(worker, diagnostics)) ended.push_back(&worker.engine->context());
  }
  // Only now: until then the others still sent them messages.
  for (component::ExecutionContext* context : ended) {
    context->live = false;
    context->wakes_on_messages = false;
  }
  workers_.clear();
  age_watch_.reset();
  gate_.reset();
  if (memory_locked_) platform::unlock_memory();
  memory_locked_ = false;
  idle_states_.reset();
}

/// One that is known to hang is not waited for.
bool Threads::join(Worker& worker, base::Diagnostics& diagnostics) {
  component::ExecutionContext& context = worker.engine->context();
  const bool known = unreachable_.includes(context);
  const base::Duration limit = known ? base::Duration::zero() : options_.stop_limit;
  if (worker.thread->join_within(limit)) return true;
  worker.thread->abandon();
  unreachable_.give_up(context);
  if (!known) diagnostics.error({}, "the thread " + quoted(context.name) + " does not end");
  return false;
}

}  // namespace armature::exec::internal
