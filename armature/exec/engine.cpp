// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/engine.hpp"

#include <algorithm>
#include <utility>

#include "armature/component/host.hpp"
#include "armature/component/lanes.hpp"
#include "armature/platform/clock.hpp"
#include "armature/rt/guard.hpp"
#include "armature/rt/ticks.hpp"

namespace armature::exec {
namespace {

using component::Component;

constexpr std::size_t kLogCapacity = 128;

/// So many rounds of messages are handled at once; what is sent by then waits for the next wake-up,
/// so that components which keep telling each other things cannot hold up a cycle.
constexpr int kMessageRounds = 64;

const char* running_component(const void* context) {
  const Component* const running =
      static_cast<const component::ExecutionContext*>(context)->running();
  return running == nullptr ? nullptr : running->name().c_str();
}

/// What happens in this scope is the work of `context`: real-time, and reported under its name.
class AtWork {
 public:
  explicit AtWork(const component::ExecutionContext& context)
      : state_(rt::guard_state()), before_(state_), realtime_(state_) {
    state_.thread = context.name.c_str();
    state_.context = &context;
    state_.running_component = &running_component;
  }
  AtWork(const AtWork&) = delete;
  AtWork& operator=(const AtWork&) = delete;
  ~AtWork() {
    state_.thread = before_.thread;
    state_.context = before_.context;
    state_.running_component = before_.running_component;
  }

 private:
  rt::GuardState& state_;
  const rt::GuardState before_;
  const rt::RealtimeScope realtime_;
};

void fault_those_in_service(const std::vector<Component*>& components, std::string_view reason) {
  for (Component* component : components) {
    const component::State state = component->state();
    const bool in_service =
        state == component::State::kRunning || state == component::State::kRunTimeError;
    if (in_service) component->fault(reason);
  }
}

}  // namespace

Engine::Engine(std::string name, Activity activity, std::vector<Component*> members,
               std::vector<Component*> updating)
    : activity_(std::move(activity)),
      context_(std::move(name)),
      log_(kLogCapacity),
      members_(std::move(members)),
      updating_(std::move(updating)),
      schedule_(activity_.period, activity_.overrun == Overrun::kCatchUp) {
  context_.log = &log_;
  if (periodic()) context_.period = activity_.period;
  for (Component* member : members_) {
    component::Host::assign_context(*member, context_);
    if (component::Host::has_aging_inputs(*member)) aging_.push_back(member);
  }
  looking_.reserve(aging_.size());
}

void Engine::keep_timeline(std::shared_ptr<component::Timeline> timeline, std::uint16_t number) {
  timeline_ = std::move(timeline);
  number_ = number;
  context_.timeline = timeline_.get();
}

void Engine::attach(ThreadWatch& watch) noexcept {
  watch.next_ = watches_;
  watches_ = &watch;
}

void Engine::detach(ThreadWatch& watch) noexcept {
  for (ThreadWatch** place = &watches_; *place != nullptr; place = &(*place)->next_) {
    if (*place != &watch) continue;
    *place = watch.next_;
    return;
  }
}

void Engine::keep_black_box(std::shared_ptr<component::BlackBox> box) {
  black_box_ = std::move(box);
  context_.black_box = black_box_.get();
}

void Engine::be_woken_by(std::shared_ptr<rt::Alarms> alarms) {
  alarms_ = std::move(alarms);
  alarm_ = alarms_->add(context_.wakeup);
}

void Engine::begin(base::Time start) {
  for (const auto& lane : context_.lanes) lane->lane.prepare();
  context_.cycle_time = start;
  schedule_.begin(start);
  next_age_check_ = start;
  context_.live = !context_.simulated;
  context_.wakes_on_messages = !context_.simulated;
  context_.wakeup.notify();  // of what was sent before nobody was told
}

void Engine::serve() {
  const AtWork at_work(context_);
  const rt::Outbox::Scope sending(context_.outbox);
  while (!ending_.load(std::memory_order_acquire)) do_due(wait());
  deliver_messages();
  close_account();
}

void Engine::end() {
  ending_.store(true, std::memory_order_release);
  context_.wakeup.notify();
}

bool Engine::has_leftovers() const {
  return !context_.inbox.empty() || !context_.next_cycle.empty();
}

void Engine::deliver_leftovers() {
  context_.next_cycle.deliver_all();
  context_.inbox.deliver_all();
}

base::Time Engine::wait() {
  const rt::PermitScope sleeping;
  const base::Time due = next_due();
  if (sleeps_through_) {
    platform::sleep_until(due);
    return platform::monotonic_now();
  }
  if (alarms_ != nullptr) alarms_->set(alarm_, due);
  if (alarms_ != nullptr || due == base::Time::max()) {
    context_.wakeup.wait();
  } else {
    context_.wakeup.wait_until(due);
  }
  return platform::monotonic_now();
}

void Engine::step(base::Time now) ARMATURE_NONBLOCKING {
  const AtWork at_work(context_);
  const rt::Outbox::Scope sending(context_.outbox);
  do_due(now);
}

void Engine::do_due(base::Time now) ARMATURE_NONBLOCKING {
  woken_ = now;
  if (!periodic() || now < schedule_.next()) {
    wake(now);
    return;
  }
  const PeriodicSchedule::Due due = schedule_.settle(now);
  latency_ns_.add(static_cast<std::uint64_t>(due.lateness.count()));
  cycles_skipped_.store(schedule_.cycles_skipped(), std::memory_order_relaxed);
  fault_if_late();
  for (std::uint64_t left = due.run; left > 0; --left) {
    // Cycles that are caught up each have their own time: whoever divides by its step may.
    run_cycle(now - static_cast<std::int64_t>(left - 1) * activity_.period);
  }
  cycles_run_.store(schedule_.cycles_run(), std::memory_order_relaxed);
}

void Engine::run_cycle(base::Time now) ARMATURE_NONBLOCKING {
  close_account();
  turn_to(now);
  open();
  begin_cycle();
  deliver_messages();
  for (Component* component : updating_) component::Host::update(*component);
  deliver_messages();
  close(true);
}

/// Handles what has arrived. For a triggered thread this is its cycle; in a periodic one it happens
/// between two cycles.
void Engine::wake(base::Time now) ARMATURE_NONBLOCKING {
  if (!has_messages() && now < next_due()) return;  // of what woke it, the last time took care
  turn_to(now);
  const bool all_is_fresh = !has_messages() && looking_.empty();
  if (!all_is_fresh) {
    open();
    if (!periodic()) begin_cycle();
    deliver_messages();
    close(!periodic());
  }
  if (periodic()) return;
  close_account();
  cycles_run_.store(context_.cycle, std::memory_order_relaxed);
  next_age_check_ = next_expiry();
  if (!context_.next_cycle.empty()) context_.wakeup.notify();
}

void Engine::begin_cycle() {
  ++context_.cycle;
  context_.measuring = --cycles_to_measured_ == 0;
  if (context_.measuring) cycles_to_measured_ = measure_every_;
  if (timeline_ != nullptr && timeline_->affords_steps()) context_.measuring = true;
  if (wanted_ != nullptr) [[unlikely]]
    begin_record();
  account_open_ = true;
  if (!context_.next_cycle.empty()) context_.next_cycle.deliver_all();
}

void Engine::begin_record() noexcept {
  context_.record = std::exchange(wanted_, nullptr);
  context_.record->open(context_.cycle, context_.cycle_time, opened_);
  context_.measuring = true;
}

void Engine::end_record(std::uint64_t tick) noexcept {
  std::exchange(context_.record, nullptr)->close(tick);
}

void Engine::turn_to(base::Time now) {
  context_.cycle_time = now;
  if (now > ages_hold_until_ || context_.ages_to_settle) [[unlikely]]
    settle_ages();
}

void Engine::open() {
  opened_ = rt::ticks();
  context_.mark = opened_;
  if (timeline_ != nullptr) timeline_->open(number_, woken_, opened_);
}

void Engine::close(bool cycle) {
  if (context_.ages_to_settle) [[unlikely]]
    settle_ages();
  if (!looking_.empty()) look_at_ages();
  if (black_box_ != nullptr && black_box_->due(context_.cycle_time)) {
    black_box_->make_picture(context_.cycle_time);
  }
  for (ThreadWatch* one = watches_; one != nullptr; one = one->next_) {
    if (one->due(context_.cycle_time)) one->copy(context_.cycle_time);
  }
  const std::uint64_t closed = rt::ticks();
  busy_ += closed - opened_;
  if (context_.record != nullptr && cycle) [[unlikely]]
    end_record(closed);
  if (timeline_ == nullptr) return;
  timeline_->close(closed, context_.cycle, context_.cycle_time, cycle, context_.measuring);
}

/// Finds those whose data is too old, or may be at any time. The others need no look for as long as
/// the oldest of their data is good for, so that it costs nothing in most cycles.
void Engine::settle_ages() {
  context_.ages_to_settle = false;
  ages_hold_until_ = base::Time::max();
  looking_.clear();
  for (Component* component : aging_) {
    if (!ages_hold(*component)) looking_.push_back(component);
  }
}

bool Engine::ages_hold(Component& component) {
  const base::Time hold = component::Host::settle_ages(component);
  if (hold < component.time()) return false;
  ages_hold_until_ = std::min(ages_hold_until_, hold);
  return true;
}

void Engine::look_at_ages() {
  for (Component* component : looking_) component::Host::admits(*component);
  deliver_messages();
  std::erase_if(looking_, [this](Component* component) { return ages_hold(*component); });
}

base::Time Engine::next_expiry() const {
  base::Time next = base::later(ages_hold_until_, base::Duration(1));
  for (const Component* component : looking_)
    next = std::min(next, component::Host::next_expiry(*component));
  return next;
}

/// The cycle and the messages since are one entry in the statistics.
void Engine::close_account() {
  if (!std::exchange(account_open_, false)) return;
  cycle_ticks_.add(std::exchange(busy_, 0));
  context_.measuring = false;
  component::Host::close_measurements(context_);
}

void Engine::deliver_messages() {
  for (int round = 0; round < kMessageRounds; ++round) {
    if (context_.outbox.any()) context_.outbox.flush();
    if (context_.inbox.empty()) return;
    context_.inbox.deliver_all();
  }
  context_.wakeup.notify();
}

void Engine::fault_if_late() {
  const bool too_late = activity_.overrun == Overrun::kFault &&
                        schedule_.late_in_a_row() >= activity_.late_cycles_to_fault;
  if (too_late) fault_those_in_service(updating_, "its thread missed too many cycles in a row");
}

void Engine::fault_members(std::string_view reason) { fault_those_in_service(members_, reason); }

}  // namespace armature::exec
