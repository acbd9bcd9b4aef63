// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/internal/hook_series.hpp"

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <memory>
#include <mutex>
#include <system_error>
#include <utility>

#include "armature/component/waits_for_operator.hpp"
#include "armature/exec/task.hpp"
#include "armature/platform/clock.hpp"
#include "armature/platform/thread.hpp"
#include "armature/rt/guard.hpp"

namespace armature::exec::internal {
namespace {

thread_local const component::Component* hooked = nullptr;

const char* name_of_hooked(const void*) {
  return hooked == nullptr ? nullptr : hooked->name().c_str();
}

/// While it exists, what happens in this thread, which runs hooks alone and so has no context, is
/// known as the work of `component`.
class AtHook {
 public:
  explicit AtHook(const component::Component& component) {
    hooked = &component;
    rt::GuardState& state = rt::guard_state();
    state.thread = kLifeCycleThread;
    state.running_component = &name_of_hooked;
  }
  AtHook(const AtHook&) = delete;
  AtHook& operator=(const AtHook&) = delete;
  ~AtHook() { hooked = nullptr; }
};

/// A series under way: shared by the thread that runs it and the one that waits, whichever lives
/// longer.
class Progress {
 public:
  explicit Progress(const HookSeries& series) : series_(series) {}

  /// In a thread that is there for that.
  void run_apart() {
    run_by([this](component::Component& component) {
      const AtHook at_hook(component);
      return series_.transition(component);
    });
  }
  void run() { run_by(series_.transition); }

  template <typename Run>
  void run_by(const Run& run_one) {
    for (component::Component* component : series_.components) {
      const component::Outcome outcome = run_one(*component);
      if (!go_on_after(*component, outcome)) break;
    }
    const std::lock_guard lock(mutex_);
    finished_ = true;
    changed_.notify_all();
  }

  /// False if one of them takes longer than the limit.
  bool wait(const HookPatience& patience) {
    const base::Duration look =
        std::min<base::Duration>(patience.limit, std::chrono::milliseconds(20));
    std::unique_lock lock(mutex_);
    std::size_t seen = 0;
    base::Time deadline = base::later(platform::monotonic_now(), limit_now(patience));
    while (!changed_.wait_for(lock, look, [this] { return finished_; })) {
      const base::Time now = platform::monotonic_now();
      if (std::exchange(seen, done_) != done_) deadline = base::later(now, limit_now(patience));
      if (now > deadline) return false;
      if (!patience.meanwhile) continue;
      lock.unlock();
      patience.meanwhile();
      lock.lock();
    }
    return true;
  }

  void leave_alone() {
    const std::lock_guard lock(mutex_);
    left_alone_ = true;
  }

  HookReport report() {
    const std::lock_guard lock(mutex_);
    const auto begin = series_.components.begin();
    return {refusals_,
            {begin + static_cast<std::ptrdiff_t>(done_), series_.components.end()},
            !finished_};
  }

 private:
  /// Of the component whose turn it is.
  base::Duration limit_now(const HookPatience& patience) const {
    const bool over = done_ >= series_.components.size();
    return over ? patience.limit : patience.limit_of(*series_.components[done_]);
  }

  bool go_on_after(component::Component& component, const component::Outcome& outcome) {
    const std::lock_guard lock(mutex_);
    ++done_;
    if (!outcome) refusals_.push_back({&component, std::string(outcome.reason())});
    return !left_alone_ && (outcome.ok() || !series_.ends_at_refusal);
  }

  const HookSeries series_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t done_ = 0;
  std::vector<HookReport::Refusal> refusals_;
  bool finished_ = false;
  bool left_alone_ = false;
};

}  // namespace

base::Duration HookPatience::limit_of(const component::Component& component) const {
  const auto* const waits = dynamic_cast<const component::WaitsForOperator*>(&component);
  if (!operators_too || waits == nullptr) return limit;
  const bool endless = limit > base::Duration::max() - waits->operators_patience();
  return endless ? base::Duration::max() : limit + waits->operators_patience();
}

HookReport run_hooks(const HookSeries& series, const HookPatience& patience) {
  if (series.components.empty()) return {};
  const auto progress = std::make_shared<Progress>(series);
  platform::ThreadRequest request;
  request.name = kLifeCycleThread;
  constexpr std::size_t kHookStack = 8u << 20;  // like a main thread's: hooks load files and models
  request.stack_bytes = kHookStack;
  request.prefault = false;
  std::unique_ptr<platform::Thread> thread;
  try {
    thread = std::make_unique<platform::Thread>(request, [progress] { progress->run_apart(); });
  } catch (const std::system_error&) {
    progress->run();  // without anybody to watch it: better than not at all
    return progress->report();
  }
  if (!progress->wait(patience)) {
    progress->leave_alone();
    thread->abandon();
  }
  return progress->report();
}

HookReport run_hooks_in(component::ExecutionContext& context, const HookSeries& series,
                        const HookPatience& patience) {
  const auto progress = std::make_shared<Progress>(series);
  Task::post(context, [progress] { progress->run(); });
  progress->wait(patience);
  return progress->report();
}

}  // namespace armature::exec::internal
