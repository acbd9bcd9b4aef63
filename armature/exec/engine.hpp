// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "armature/base/realtime.hpp"
#include "armature/base/time.hpp"
#include "armature/component/black_box.hpp"
#include "armature/component/component.hpp"
#include "armature/component/observing/cycle_record.hpp"
#include "armature/component/observing/timeline.hpp"
#include "armature/exec/activity.hpp"
#include "armature/exec/periodic_schedule.hpp"
#include "armature/exec/thread_watch.hpp"
#include "armature/rt/alarms.hpp"
#include "armature/rt/log.hpp"
#include "armature/rt/statistics.hpp"

namespace armature::exec {

/// Executes the components of one thread: messages from other threads, then the updates.
class Engine {
 public:
  /// @param members   all components of the thread
  /// @param updating  those whose update is run in each cycle, in this order
  Engine(std::string name, Activity activity, std::vector<component::Component*> members,
         std::vector<component::Component*> updating);
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  component::ExecutionContext& context() { return context_; }
  const component::ExecutionContext& context() const { return context_; }
  const Activity& activity() const { return activity_; }
  rt::LogQueue& log() { return log_; }

  /// Execution times of components are taken in every n-th cycle.
  void measure_every(std::uint64_t cycles) { measure_every_ = cycles_to_measured_ = cycles; }

  /// Its cycles come at these times instead of once a period. Of a periodic thread, in simulated
  /// time.
  void follow(std::vector<base::Time> times) { schedule_.follow(std::move(times)); }

  /// Has everything that the thread does go to a timeline as well.
  void keep_timeline(std::shared_ptr<component::Timeline> timeline, std::uint16_t number);

  /// Has what its components write and do lately kept.
  void keep_black_box(std::shared_ptr<component::BlackBox> box);

  /// Has numbers copied after its cycles, until `detach`.
  /// @rt nonblocking, no allocation
  /// @thread its own, or any while it does not run, as for `detach`
  void attach(ThreadWatch& watch) noexcept;
  /// No effect if it was not attached.
  /// @rt nonblocking, no allocation, O(watches)
  void detach(ThreadWatch& watch) noexcept;

  /// Has the next cycle recorded with its steps.
  /// @rt nonblocking, no allocation
  /// @thread its own, or any while it does not run
  void record_next_cycle(component::CycleRecord& record) noexcept { wanted_ = &record; }

  /// Has messages wait for the next cycle, so that who sends them has nobody to wake. Of a periodic
  /// thread, whose end waits for that, too. Before its loop begins.
  void sleep_through() { sleeps_through_ = true; }
  bool sleeps_through() const { return sleeps_through_; }

  /// Whether it sleeps until data becomes too old, beside messages.
  bool sleeps_until_ages() const { return !periodic() && !aging_.empty(); }
  /// Has somebody else wake it then. Before its loop begins.
  void be_woken_by(std::shared_ptr<rt::Alarms> alarms);

  /// From now on the thread's cycles count; the components have been started.
  void begin(base::Time start);

  /// The thread's loop, until `end`.
  /// @rt
  void serve();
  /// Ends the loop.
  /// @thread any
  void end();
  /// What arrived after the loop had ended.
  /// @thread whoever joined the engine's own
  bool has_leftovers() const;
  void deliver_leftovers();
  /// Ends the statistics of the last cycle.
  /// @thread its own, or whoever joined that
  void close_account();

  // --- the same in single steps, for simulated time ----------------------------------------------
  bool has_messages() const {
    return !context_.inbox.empty() || (!periodic() && !context_.next_cycle.empty());
  }
  /// When the engine has something to do without a message; the end of time for a triggered thread
  /// whose inputs have no age.
  base::Time next_due() const {
    if (periodic()) return schedule_.next();
    return sleeps_until_ages() ? next_age_check_ : base::Time::max();
  }
  /// Handles the messages, and the cycles that are due at `now`.
  /// @rt
  void step(base::Time now) ARMATURE_NONBLOCKING;

  /// Takes its running components out of service.
  /// @rt nonblocking
  /// @thread its own
  void fault_members(std::string_view reason);

  /// @thread any
  std::uint64_t cycles_run() const { return cycles_run_.load(std::memory_order_relaxed); }
  std::uint64_t cycles_skipped() const { return cycles_skipped_.load(std::memory_order_relaxed); }
  /// How much later than due each periodic cycle began [ns].
  const rt::Distribution& latency_ns() const { return latency_ns_; }
  /// Duration of each cycle [ticks]; of a periodic one with the messages up to the next cycle.
  const rt::Distribution& cycle_ticks() const { return cycle_ticks_; }

 private:
  base::Time wait();
  void do_due(base::Time now) ARMATURE_NONBLOCKING;
  void run_cycle(base::Time now) ARMATURE_NONBLOCKING;
  void wake(base::Time now) ARMATURE_NONBLOCKING;
  void turn_to(base::Time now);
  void open();
  void close(bool cycle);
  void begin_cycle();
  void begin_record() noexcept;
  void end_record(std::uint64_t tick) noexcept;
  void settle_ages();
  bool ages_hold(component::Component& component);
  void look_at_ages();
  base::Time next_expiry() const;
  void deliver_messages();
  void fault_if_late();

  bool periodic() const { return activity_.kind == Activity::Kind::kPeriodic; }

  Activity activity_;
  component::ExecutionContext context_;
  rt::LogQueue log_;
  std::vector<component::Component*> members_;
  std::vector<component::Component*> updating_;
  std::vector<component::Component*> aging_;    ///< whose inputs have declared ages
  std::vector<component::Component*> looking_;  ///< those of them that look before each handler
  base::Time ages_hold_until_{};                ///< none of the others has to look before
  base::Time next_age_check_ = base::Time::max();
  PeriodicSchedule schedule_;
  std::uint64_t measure_every_ = 1;
  std::uint64_t cycles_to_measured_ = measure_every_;
  std::uint64_t opened_ = 0;  ///< tick
  std::uint64_t busy_ = 0;    ///< ticks of the cycle whose account is open
  bool account_open_ = false;
  base::Time woken_{};  ///< what the clock said
  bool sleeps_through_ = false;
  std::shared_ptr<rt::Alarms> alarms_;
  std::size_t alarm_ = 0;  ///< its number there
  std::shared_ptr<component::BlackBox> black_box_;
  ThreadWatch* watches_ = nullptr;            ///< the first of those that are attached
  component::CycleRecord* wanted_ = nullptr;  ///< to be filled by the next cycle
  std::shared_ptr<component::Timeline> timeline_;
  std::uint16_t number_ = 0;  ///< in the timeline
  std::atomic<bool> ending_{false};
  std::atomic<std::uint64_t> cycles_run_{0};
  std::atomic<std::uint64_t> cycles_skipped_{0};
  rt::Distribution latency_ns_;
  rt::Distribution cycle_ticks_;
};

}  // namespace armature::exec
