// SPDX-License-Identifier: Apache-2.0
#pragma once

// For tests: a thread whose cycles the test itself runs, and a component that does as it is told.

#include <functional>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "armature/component/component.hpp"
#include "armature/component/host.hpp"
#include "armature/component/lanes.hpp"

namespace armature::component {

/// Stands for a thread: components are added to it, and it does something only when the test says.
class TestThread {
 public:
  explicit TestThread(std::string name = "thread") : context(std::move(name)) {}

  template <typename... Components>
  explicit TestThread(Component& first, Components&... others) : TestThread() {
    add(first, others...);
  }
  template <typename... Components>
  void add(Components&... components) {
    (Host::assign_context(components, context), ...);
  }

  /// Its connections are made: from now on data may leave it in batches.
  void prepare_lanes() {
    for (const auto& lane : context.lanes) lane->lane.prepare();
  }

  /// Handles all messages, also those that their handling causes.
  void deliver() {
    while (!context.inbox.empty()) context.inbox.deliver_all();
  }
  /// Handles the messages that are here now, and says how many they are.
  int deliver_and_count() {
    int count = 0;
    for (rt::Message* each = context.inbox.take_all(); each != nullptr; ++count) {
      rt::Message* const next = rt::Inbox::next(*each);
      each->deliver();
      each = next;
    }
    return count;
  }
  /// Begins the next cycle, `duration` later.
  void cycle(base::Duration duration = std::chrono::milliseconds(1)) {
    context.cycle_time = context.cycle_time.load() + duration;
    ++context.cycle;
    context.next_cycle.deliver_all();
    deliver();
  }

  ExecutionContext context;
};

/// Brings components to Running.
template <typename... Components>
void start(Components&... components) {
  const auto start_one = [](Component& component) {
    if (component.state() == State::kPreOperational) {
      const Outcome configured = Host::configure(component);
      EXPECT_TRUE(configured) << component.name() << ": " << configured.reason();
    }
    const Outcome activated = Host::activate(component);
    EXPECT_TRUE(activated) << component.name() << ": " << activated.reason();
    const Outcome started = Host::start(component);
    EXPECT_TRUE(started) << component.name() << ": " << started.reason();
  };
  (start_one(components), ...);
}

/// Notes which hooks ran, and does in each what the test put there.
class ProbeComponent : public Component {
 public:
  using Component::Component;
  using Component::error;

  std::vector<std::string> calls;
  std::map<std::string, std::string> refusals;
  std::map<std::string, std::function<void()>> actions;

 private:
  Outcome on_configure() override { return answer("configure"); }
  Outcome on_activate() override { return answer("activate"); }
  Outcome on_start() override { return answer("start"); }
  void on_update() override { note("update"); }
  void on_stop() override { note("stop"); }
  void on_cleanup() override { note("cleanup"); }
  void on_error() override { note("error"); }
  Outcome on_reset() override { return answer("reset"); }

  void note(const std::string& hook) {
    calls.push_back(hook);
    if (const auto action = actions.find(hook); action != actions.end()) action->second();
  }
  Outcome answer(const std::string& hook) {
    note(hook);
    const auto refusal = refusals.find(hook);
    return refusal == refusals.end() ? accepted() : refused(refusal->second);
  }
};

/// Remembers what it was told.
class TestSupervisor final : public Supervisor {
 public:
  void component_faulted(Component& component) override { faulted.push_back(component.name()); }
  void component_stopped_itself(Component& component) override {
    stopped.push_back(component.name());
  }
  std::vector<std::string> faulted;
  std::vector<std::string> stopped;
};

}  // namespace armature::component
