// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/engine.hpp"

#include <algorithm>
#include <utility>

#include "armature/component/input_port.hpp"
#include "armature/platform/clock.hpp"
#include "armature/rt/guard.hpp"

namespace armature::exec {
namespace {

constexpr std::size_t kLogCapacity = 128;

/// So many rounds of messages are handled at once; what is sent by then waits for the next wake-up,
/// so that components which keep telling each other things cannot hold up a cycle.
constexpr int kMessageRounds = 64;

const char* running_component(const void* context) {
  const auto* running = static_cast<const component::ExecutionContext*>(context)->running;
  return running == nullptr ? nullptr : running->name().c_str();
}

/// What happens in this scope is the work of `context`: real-time, and reported under its name.
class AtWork {
 public:
  explicit AtWork(const component::ExecutionContext& context) : before_(rt::guard_state()) {
    rt::GuardState& state = rt::guard_state();
    state.thread = context.name.c_str();
    state.context = &context;
    state.running_component = &running_component;
  }
  AtWork(const AtWork&) = delete;
  AtWork& operator=(const AtWork&) = delete;
  ~AtWork() {
    rt::GuardState& state = rt::guard_state();
    state.thread = before_.thread;
    state.context = before_.context;
    state.running_component = before_.running_component;
  }

 private:
  const rt::GuardState before_;
  const rt::RealtimeScope realtime_;
};

}  // namespace

bool Task::run_in(component::ExecutionContext& context, std::function<void()> work,
                  base::Duration limit) {
  const std::shared_ptr<Task> task(new Task(std::move(work)));
  task->self_ = task;
  context.post(*task);
  const base::Time deadline = platform::monotonic_now() + limit;
  while (!task->done_.load(std::memory_order_acquire)) {
    if (!task->finished_.wait_until(deadline)) break;
  }
  return task->done_.load(std::memory_order_acquire);
}

void Task::deliver(rt::Message& message) {
  auto& task = static_cast<Task&>(message);
  const rt::PermitScope permit;  // asked for by a tool, not part of the control loop
  const std::shared_ptr<Task> keep = std::move(task.self_);
  task.work_();
  task.done_.store(true, std::memory_order_release);
  task.finished_.notify();
}

Engine::Engine(std::string name, Activity activity, std::vector<component::Component*> members,
               std::vector<component::Component*> updating)
    : activity_(std::move(activity)),
      context_(std::move(name)),
      log_(kLogCapacity),
      members_(std::move(members)),
      updating_(std::move(updating)),
      schedule_(activity_.period, activity_.overrun == Overrun::kCatchUp) {
  context_.log = &log_;
  for (component::Component* member : members_) member->assign_context(context_);
}

void Engine::begin(base::Time start) {
  context_.cycle_time = start;
  schedule_.begin(start);
  aging_.clear();
  age_tick_ = base::Duration::max();
  for (component::Component* member : members_) {
    if (!member->has_aging_inputs()) continue;
    aging_.push_back(member);
    for (const component::InputPortBase* input : member->interface().inputs) {
      if (input->max_age() > base::Duration::zero()) {
        age_tick_ = std::min(age_tick_, input->max_age());
      }
    }
  }
  next_age_check_ = start;
  if (!aging_.empty()) next_age_check_ += age_tick_;
  context_.live = !context_.simulated;
  context_.wakes_on_messages = !context_.simulated;
}

void Engine::serve() {
  const AtWork at_work(context_);
  while (!ending_.load(std::memory_order_acquire)) do_due(wait());
  deliver_messages();
}

void Engine::end() {
  ending_.store(true, std::memory_order_release);
  context_.wakeup.notify();
}

std::optional<base::Time> Engine::next_due() const {
  if (activity_.kind == Activity::Kind::kPeriodic) return schedule_.next();
  if (!aging_.empty()) return next_age_check_;
  return std::nullopt;
}

base::Time Engine::wait() {
  const rt::PermitScope sleeping;
  if (const std::optional<base::Time> due = next_due()) {
    context_.wakeup.wait_until(*due);
  } else {
    context_.wakeup.wait();
  }
  return platform::monotonic_now();
}

void Engine::step(base::Time now) ARMATURE_NONBLOCKING {
  const AtWork at_work(context_);
  do_due(now);
}

void Engine::do_due(base::Time now) ARMATURE_NONBLOCKING {
  if (activity_.kind != Activity::Kind::kPeriodic || now < schedule_.next()) {
    wake(now);
    return;
  }
  const PeriodicSchedule::Due due = schedule_.settle(now);
  latency_ns_.add(static_cast<std::uint64_t>(due.lateness.count()));
  cycles_skipped_.store(schedule_.cycles_skipped(), std::memory_order_relaxed);
  fault_if_late();
  for (std::uint64_t i = 0; i < due.run; ++i) run_cycle(now);
  cycles_run_.store(schedule_.cycles_run(), std::memory_order_relaxed);
}

void Engine::run_cycle(base::Time now) ARMATURE_NONBLOCKING {
  open_cycle(now);
  begin_next_cycle();
  deliver_messages();
  for (component::Component* component : updating_) component->update();
  deliver_messages();
  close_cycle();
}

/// Handles what has arrived. For a triggered thread this is its cycle; in a periodic one it happens
/// between two cycles.
void Engine::wake(base::Time now) ARMATURE_NONBLOCKING {
  open_cycle(now);
  const bool triggered = activity_.kind == Activity::Kind::kTriggered;
  if (triggered) begin_next_cycle();
  deliver_messages();
  close_cycle();
  if (!triggered) return;
  cycles_run_.store(context_.cycle, std::memory_order_relaxed);
  if (!context_.next_cycle.empty()) context_.wakeup.notify();
}

void Engine::begin_next_cycle() {
  ++context_.cycle;
  deliver(context_.next_cycle.take_all());
}

void Engine::open_cycle(base::Time now) {
  context_.cycle_time = now;
  opened_ = rt::ticks();
  context_.measuring = context_.cycle % measure_every_ == 0;
  context_.mark = opened_;
}

void Engine::close_cycle() {
  for (component::Component* component : aging_) component->admits();
  if (!aging_.empty()) {
    next_age_check_ = context_.cycle_time.load() + age_tick_;
    deliver_messages();
  }
  cycle_ticks_.add(rt::ticks() - opened_);
  if (!context_.measuring) return;
  context_.measuring = false;
  for (component::Component* member : members_) member->close_measurement();
}

void Engine::deliver_messages() {
  for (int round = 0; round < kMessageRounds; ++round) {
    rt::Message* message = context_.inbox.empty() ? nullptr : context_.inbox.take_all();
    if (message == nullptr) return;
    deliver(message);
  }
  context_.wakeup.notify();
}

void Engine::deliver(rt::Message* message) {
  while (message != nullptr) {
    rt::Message* const next = rt::Inbox::next(*message);
    message->deliver();
    message = next;
  }
}

bool Engine::has_messages() const {
  const bool triggered = activity_.kind == Activity::Kind::kTriggered;
  return !context_.inbox.empty() || (triggered && !context_.next_cycle.empty());
}

void Engine::fault_if_late() {
  const bool too_late = activity_.overrun == Overrun::kFault &&
                        schedule_.late_in_a_row() >= activity_.late_cycles_to_fault;
  if (!too_late) return;
  for (component::Component* component : updating_) {
    component->fault("its thread missed too many cycles in a row");
  }
}

}  // namespace armature::exec
