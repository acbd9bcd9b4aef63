// SPDX-License-Identifier: Apache-2.0
#pragma once

// For tests: components that do as they are told, and short ways to plan and run them.

#include <chrono>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/exec/application.hpp"
#include "armature/exec/plan.hpp"
#include "armature/platform/clock.hpp"

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
  std::vector<std::string> entries() const {
    const std::lock_guard lock(mutex_);
    return entries_;
  }
  void clear() {
    const std::lock_guard lock(mutex_);
    entries_.clear();
  }

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> entries_;
};

/// Notes which of its hooks ran, and does in each what the test put there; an action under the name
/// of a hook runs in it, and a refusal is its answer.
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
    if (journal != nullptr) journal->note(name() + " " + hook);
    if (const auto action = actions.find(hook); action != actions.end()) action->second();
  }
  component::Outcome answer(const std::string& hook) {
    act(hook);
    const auto refusal = refusals.find(hook);
    return refusal == refusals.end() ? component::accepted() : component::refused(refusal->second);
  }
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

inline ApplicationOptions simulated() {
  ApplicationOptions options;
  options.simulated = true;
  return options;
}

}  // namespace armature::exec
