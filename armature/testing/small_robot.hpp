// SPDX-License-Identifier: Apache-2.0
#pragma once

// A small robot, for tests of what looks at applications and commands them.

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "armature/component/author.hpp"
#include "armature/exec/application.hpp"

namespace armature::testing::small_robot {

using namespace component;
using namespace std::chrono_literals;

/// A struct that is a property.
struct Gains {
  double kp = 0.0;
  int steps = 1;
};
ARMATURE_STRUCT(Gains, (kp, "V/rad", "proportional gain"), (steps, "", "in each cycle"));

enum class Stance : std::uint8_t { kFree, kHolding };
ARMATURE_ENUM(Stance, kFree, kHolding);

/// Has a property of each kind, and operations with arguments.
class Settings final : public Component {
 public:
  using Component::Component;

  Property<bool> loud{this, "Loud", false, "says more", "", changeable_while_running};
  Property<int> count{this, "Count", 3, "how many", "", range(0, 10), changeable_while_running};
  Property<std::uint8_t> byte{this, "Byte", 0, "small", "", changeable_while_running};
  Property<double> gain{this, "Gain", 2.5, "of it all", "V/rad", changeable_while_running};
  Property<double> fixed{this, "Fixed", 1.0, "for the whole run"};
  Property<std::string> label{this, "Label", "left", "its name", "", changeable_while_running};
  Property<std::vector<double>> offsets{
      this, "Offsets", {0.5, -1.0}, "of each joint", "rad", changeable_while_running};
  Property<std::array<int, 3>> limits{this,    "Limits", {1, 2, 3},
                                      "three", "",       changeable_while_running};
  Property<Stance> stance{this,           "Stance", Stance::kFree,
                          "what it does", "",       changeable_while_running};
  Property<Gains> gains{this, "Gains", {}, "a struct", "", changeable_while_running};
  Attribute<std::uint64_t> calls{this, "Calls", 0, "how often it was called"};

 private:
  double sum(const std::vector<double>& values, double factor) {
    calls.assign(calls.get() + 1);
    double total = 0.0;
    for (const double value : values) total += value;
    return factor * total;
  }
  std::vector<double> twice(const std::vector<double>& values) {
    std::vector<double> both(values);
    both.insert(both.end(), values.begin(), values.end());
    return both;
  }
  void fail() { throw std::runtime_error("it broke"); }

  Operation<double(const std::vector<double>&, double)> sum_{
      this,           "sum",         serve<&Settings::sum>,
      "adds them up", in_own_thread, args("values [rad]", "factor")};
  Operation<std::vector<double>(const std::vector<double>&)> twice_{
      this, "twice", serve<&Settings::twice>, "one behind the other", in_own_thread};
  Operation<void()> fail_{this, "fail", serve<&Settings::fail>, "throws", in_own_thread};
};

/// Goes to a place, a unit in each cycle, and notes when it was told to.
class Axis final : public Component {
 public:
  using Component::Component;

  std::vector<base::Duration> told_at;

 private:
  Outcome begin_move(double target) {
    if (!(target >= 0.0 && target <= 1000.0)) return refused("the target is outside the axis");
    told_at.push_back(time() - base::Time{});
    target_ = target;
    return accepted();
  }
  Outcome begin_arm() {
    arm_.complete();
    return accepted();
  }
  void on_update() override {
    if (position_ != target_) position_ += position_ < target_ ? 1.0 : -1.0;
    if (position_ == 13.0) move_.fail("the axis is stuck");
    move_.report(target_ == 0.0 ? 1.0 : position_ / target_);
    port_.write(position_);
    all_.write({position_, -position_});
  }
  bool arrived() { return position_ == target_; }
  void brake() { target_ = position_; }

  OutputPort<double> port_{this, "Position", "where it is", "m"};
  OutputPort<std::array<double, 2>> all_{this, "Both", "there and back", "m"};
  Command<double> move_{this,
                        "moveTo",
                        serve<&Axis::begin_move>,
                        "goes there",
                        args("target [m]"),
                        done_when<&Axis::arrived>,
                        cancelled_by<&Axis::brake>};
  Command<> arm_{this, "arm", serve<&Axis::begin_arm>, "lets it move", by_operator};

  double position_ = 0.0;
  double target_ = 0.0;
};

/// An axis and a component with settings, a cycle each 10 ms, started.
class SmallRobot {
 public:
  /// @param more  adds components of the test's own
  explicit SmallRobot(bool simulated = true, std::vector<exec::Grant> grants = {},
                      const std::function<void(exec::Blueprint&)>& more = {}) {
    exec::Blueprint blueprint;
    axis_ = &blueprint.add<Axis>("Axis", exec::Activity::periodic(10ms));
    settings_ = &blueprint.add<Settings>("Settings", exec::Activity::periodic(10ms));
    blueprint.add<Settings>("left.hand.Finger");
    blueprint.add<Settings>("aic-1");
    for (exec::ComponentEntry& entry : blueprint.components) entry.model = "Settings";
    blueprint.components.front().model = "Axis";
    if (more) more(blueprint);
    exec::ApplicationOptions options;
    options.simulated = simulated;
    options.hook_limit = 60s;
    options.stop_limit = 60s;
    options.grants = std::move(grants);
    application_.emplace(std::move(blueprint), std::move(options));
    const base::Diagnostics started = application_->start();
    EXPECT_EQ(started.to_text(), "");
  }

  Axis& axis() { return *axis_; }
  Settings& settings() { return *settings_; }
  exec::Application& application() { return *application_; }

 private:
  Axis* axis_ = nullptr;
  Settings* settings_ = nullptr;
  std::optional<exec::Application> application_;
};

}  // namespace armature::testing::small_robot
