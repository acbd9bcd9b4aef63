// SPDX-License-Identifier: Apache-2.0
#pragma once

// Components that the tests of this library wire up.

#include <atomic>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "armature/component/author.hpp"

namespace armature::exec::test {

using namespace armature::component;

/// What happened, in order; shared by the components of a test.
using Journal = std::vector<std::string>;

/// Writes a count in each cycle, and raises an event before.
class Counter : public Component {
 public:
  using Component::Component;
  Event<std::int64_t> tick{this, "Tick", "before each count"};
  OutputPort<double> count{this, "Count", "cycles", "rad"};

 private:
  void on_update() override {
    tick.raise(cycles_);
    count.write(static_cast<double>(++cycles_));
  }
  std::int64_t cycles_ = 0;
};

/// Passes on what it is given, by a factor.
class Gain : public Component {
 public:
  using Component::Component;
  Property<double> factor{this, "Factor", 2.0, "of the output", "", changeable_while_running};
  InputPort<double> in{this, "In", "value", "rad", on_data<&Gain::step>};
  OutputPort<double> out{this, "Out", "value times factor", "rad"};
  Operation<double(double)> scale{this, "scale", serve<&Gain::scaled>, "value times factor",
                                  in_own_thread};
  std::atomic<int> steps{0};
  int throw_at = 0;

 private:
  void step(double value) {
    if (++steps == throw_at) throw std::runtime_error("broken tooth");
    out.write(factor * value);
  }
  double scaled(double value) { return factor * value; }
};

/// Keeps the last value, and reacts to Tick.
class Sink : public Component {
 public:
  using Component::Component;
  InputPort<double> in{this, "In", "value", "rad"};
  EventHandler<std::int64_t> tick{this, "Tick", serve<&Sink::on_tick>, "counts", optional};
  std::atomic<int> ticks{0};

 private:
  void on_tick(std::int64_t) { ++ticks; }
};

/// Notes its life in a journal; hooks can be told to refuse or throw.
class Witness : public Component {
 public:
  using Component::Component;
  Journal* journal = nullptr;
  std::string refuse_in;
  std::string throw_in;
  InputPort<double> in{this, "In", "value", "rad", may_stay_open};
  OutputPort<double> out{this, "Out", "value", "rad"};

 private:
  Outcome hook(const std::string& hook_name) {
    if (journal != nullptr) journal->push_back(name() + " " + hook_name);
    if (throw_in == hook_name) throw std::runtime_error("thrown in " + hook_name);
    return refuse_in == hook_name ? refused("not today") : accepted();
  }
  Outcome on_configure() override { return hook("configure"); }
  Outcome on_activate() override { return hook("activate"); }
  Outcome on_start() override { return hook("start"); }
  void on_update() override {
    if (throw_in == "update") throw std::runtime_error("thrown in update");
  }
  void on_stop() override { static_cast<void>(hook("stop")); }
  void on_cleanup() override { static_cast<void>(hook("cleanup")); }
};

}  // namespace armature::exec::test
