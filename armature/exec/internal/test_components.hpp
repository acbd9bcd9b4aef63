// SPDX-License-Identifier: Apache-2.0
#pragma once

// For tests: components that do as they are told, and short ways to plan and run them.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/exec/application.hpp"
#include "armature/exec/plan.hpp"
#include "armature/platform/clock.hpp"
#include "armature/rt/guard.hpp"

namespace armature::exec {

using namespace std::chrono_literals;

/// What a plan finds wrong, one line for each mistake.
inline std::string problems_of(const Blueprint& blueprint) {
  base::Diagnostics diagnostics;
  make_plan(blueprint, diagnostics);
  return diagnostics.to_text();
}

/// What happened, in order, from whichever thread.
class Journal {
 public:
  void note(std::string entry) {
    const std::lock_guard lock(mutex_);
    entries_.push_back(std::move(entry));
  }
  /// What was noted since the last time.
  std::vector<std::string> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(entries_, {});
  }

 private:
  std::mutex mutex_;
  std::vector<std::string> entries_;
};

/// Notes which of its hooks and handlers ran, and does in each what the test put there. Hooks are
/// named configure, activate, start, update, stop, cleanup, error and reset, the handler in.
class Probe : public component::Component {
 public:
  using Component::Component;
  using Component::error;
  using Component::log_info;

  Journal* journal = nullptr;
  std::map<std::string, std::function<void()>> actions;
  std::map<std::string, std::string> refusals;

  component::InputPort<double> in{this,
                                  "In",
                                  "runs the handler",
                                  "",
                                  component::on_data<&Probe::on_in>,
                                  component::may_stay_open};
  component::InputPort<double> look{this, "Look", "is only read", "", component::may_stay_open};
  component::OutputPort<double> out{this, "Out", "whatever the test writes"};

  void throw_in(const std::string& hook) {
    actions[hook] = [hook] { throw std::runtime_error("thrown in " + hook); };
  }

 protected:
  component::Outcome answer(const std::string& hook) {
    act(hook);
    const auto refusal = refusals.find(hook);
    return refusal == refusals.end() ? component::accepted() : component::refused(refusal->second);
  }

 private:
  component::Outcome on_configure() override { return answer("configure"); }
  component::Outcome on_activate() override { return answer("activate"); }
  component::Outcome on_start() override { return answer("start"); }
  void on_update() override { act("update"); }
  void on_stop() override { act("stop"); }
  void on_cleanup() override { act("cleanup"); }
  void on_error() override { act("error"); }
  component::Outcome on_reset() override { return answer("reset"); }
  void on_in() { act("in"); }

  void act(const std::string& hook) {
    const rt::PermitScope what_a_test_does_is_no_real_time_code;
    if (journal != nullptr) journal->note(name() + " " + hook);
    if (const auto action = actions.find(hook); action != actions.end()) action->second();
  }
};

/// Raises an event and writes a count in each cycle.
class Counter : public component::Component {
 public:
  using Component::Component;
  component::Event<std::int64_t> tick{this, "Tick", "before each count"};
  component::OutputPort<double> count{this, "Count", "cycles", "rad"};

 private:
  void on_update() override {
    tick.raise(cycles_);
    count.write(static_cast<double>(++cycles_));
  }
  std::int64_t cycles_ = 0;
};

/// Passes on what it is given, by a factor.
class Gain : public component::Component {
 public:
  using Component::Component;
  component::Property<double> factor{
      this, "Factor", 2.0, "of the output", "", component::changeable_while_running};
  component::InputPort<double> in{this, "In", "value", "rad", component::on_data<&Gain::step>};
  component::OutputPort<double> out{this, "Out", "value times factor", "rad"};
  component::Operation<double(double)> scale{this, "scale", component::serve<&Gain::scaled>,
                                             "value times factor", component::in_own_thread};
  std::atomic<int> steps{0};
  int throw_at = 0;

 private:
  void step(double value) {
    if (++steps == throw_at) {
      const rt::PermitScope throwing;
      throw std::runtime_error("broken tooth");
    }
    out.write(factor * value);
  }
  double scaled(double value) { return factor * value; }
};

/// Keeps the last value, and reacts to Tick.
class Sink : public component::Component {
 public:
  using Component::Component;
  component::InputPort<double> in{this, "In", "value", "rad"};
  component::EventHandler<std::int64_t> tick{this, "Tick", component::serve<&Sink::on_tick>,
                                             "counts", component::optional};
  std::atomic<int> ticks{0};

 private:
  void on_tick(std::int64_t) { ++ticks; }
};

/// Lets the application run until `condition` holds; false if that takes absurdly long.
inline bool run_until(Application& application, const std::function<bool()>& condition) {
  const base::Time deadline = platform::monotonic_now() + 60s;
  while (!condition()) {
    if (platform::monotonic_now() > deadline) return false;
    application.run_for(1ms);
  }
  return true;
}

/// Limits that a busy machine does not reach, unless a test is about them.
inline ApplicationOptions patient(bool simulated) {
  ApplicationOptions options;
  options.simulated = simulated;
  options.hook_limit = 60s;
  options.stop_limit = 60s;
  return options;
}

}  // namespace armature::exec
