// SPDX-License-Identifier: Apache-2.0
// An application's threads: what is asked of the system for them, and what was granted.
#include <exception>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "armature/exec/application.hpp"
#include "armature/exec/internal/age_watch.hpp"
#include "armature/exec/internal/directory.hpp"
#include "armature/exec/internal/start_gate.hpp"
#include "armature/platform/death_watch.hpp"
#include "armature/platform/memory.hpp"

namespace armature::exec {
namespace {

using internal::quoted;

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

bool Application::prepare_threads(base::Diagnostics& diagnostics) {
  verdict_ = {};
  if (options_.simulated) return true;
  if (options_.realtime != RealtimeMode::kOff) reserve_system();
  gate_ = std::make_shared<internal::StartGate>();
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

void Application::start_workers() {
  for (Index t = 0; t < engines_.size(); ++t) {
    const bool idle = plan_.threads[t].members.empty() && t == plan_.service_thread();
    if (!idle) start_worker(t);
  }
  age_watch_ =
      std::make_unique<internal::AgeWatch>(engines_, options_.realtime != RealtimeMode::kOff);
  if (const platform::ThreadGrant* grant = age_watch_->grant()) {
    verdict_.lines.push_back(line_of(age_watch_->request(), *grant));
  }
}

void Application::reserve_system() {
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

void Application::start_worker(Index thread) {
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

/// False if the one who waits for this moment has an objection.
bool Application::get_ready(base::Diagnostics& diagnostics) {
  if (memory_locked_) platform::populate_memory();
  if (!options_.ready) return true;
  try {
    options_.ready();
  } catch (const std::exception& thrown) {
    diagnostics.error({}, std::string("not ready: ") + thrown.what());
  } catch (...) {
    diagnostics.error({}, "not ready: an exception of an unknown type");
  }
  return diagnostics.ok();
}

void Application::go_live() {
  const base::Time begin = now();
  for (auto& engine : engines_) engine->begin(begin);
  running_ = true;
  if (gate_ != nullptr) gate_->open();
}

void Application::end_threads(base::Diagnostics& diagnostics) {
  if (gate_ != nullptr) gate_->give_up();
  for (auto& engine : engines_) engine->end();
  std::vector<component::ExecutionContext*> ended;
  for (Worker& worker : workers_) {
    component::ExecutionContext& context = worker.engine->context();
    const bool known = stuck_.count(&context) > 0;
    const base::Duration limit = known ? base::Duration::zero() : options_.stop_limit;
    if (worker.thread->join_within(limit)) {
      ended.push_back(&context);
      continue;
    }
    worker.thread->abandon();
    give_up_thread(context);
    if (!known) diagnostics.error({}, "the thread " + quoted(context.name) + " does not end");
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

}  // namespace armature::exec
