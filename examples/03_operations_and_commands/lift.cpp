// SPDX-License-Identifier: Apache-2.0
// One component uses another: a plain operation, an operation in the owner's thread, and a command
// that goes on after it was accepted.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "armature/component/author.hpp"

using namespace armature::component;

namespace {

/// A lift that travels at constant speed.
class Lift final : public Component {
 public:
  using Component::Component;

 private:
  Outcome on_start() override {
    updated_ = time();
    return accepted();
  }
  void on_update() override {
    // Not a constant: the deployment says the period.
    const std::chrono::duration<double> elapsed = time() - std::exchange(updated_, time());
    const double step = speed_ * elapsed.count();
    height_ += std::clamp(target_ - height_, -step, step);
    if (start_ != target_) travel_.report((height_ - start_) / (target_ - start_));
  }

  // Served in the caller's thread: it only looks at a constant.
  double top() { return top_; }

  // Served in the lift's own thread, between two updates.
  double height() { return height_; }

  // A command: accepted or refused at once, done later.
  Outcome begin_travel(double target) {
    if (!(target >= 0.0 && target <= top_)) return refused("the target is outside the shaft");
    start_ = height_;
    target_ = target;
    return accepted();
  }
  bool arrived() { return std::abs(target_ - height_) < 1e-9; }
  void halt() { target_ = height_; }

  Property<double> top_{this, "Top", 3.0, "highest position", "m", range(0.0, 100.0)};
  Property<double> speed_{this, "Speed", 1.0, "of travel", "m/s", range(0.0, 10.0)};
  Operation<double()> get_top_{this, "top", serve<&Lift::top>, "highest position [m]"};
  Operation<double()> get_height_{this, "height", serve<&Lift::height>, "present position [m]",
                                  in_own_thread};
  Command<double> travel_{this,
                          "travel",
                          serve<&Lift::begin_travel>,
                          "goes to a height",
                          args("target [m]"),
                          done_when<&Lift::arrived>,
                          cancelled_by<&Lift::halt>};

  double height_ = 0.0;
  double start_ = 0.0;
  double target_ = 0.0;
  armature::base::Time updated_{};
};

/// Sends the lift up, too high, and down again, and cancels the last journey half way.
class Passenger final : public Component {
 public:
  using Component::Component;

 private:
  void on_update() override {
    if (stage_ == 0 || journey_.ended()) next_journey();
    if (stage_ == 3 && journey_.progress() > 0.5 && !cancelled_) {
      cancelled_ = true;
      journey_.cancel();
    }
  }

  void next_journey() {
    if (stage_ > 0) {
      const auto height = height_();
      log_info("journey {}: {} at {} m {}", stage_, name_of(journey_.stage()), height.value,
               journey_.reason());
    } else {
      log_info("the lift goes up to {} m", top_().value);
    }
    static constexpr double kTargets[] = {2.0, 10.0, 0.5};
    if (stage_ < 3) {
      journey_ = travel_.send(kTargets[stage_]);
    } else {
      journey_ = CommandHandle(CallStatus::kNotReady);
      stop();
    }
    ++stage_;
  }

  OperationCaller<double()> top_{this, "top", "how high it goes"};
  OperationCaller<double()> height_{this, "height", "where it is"};
  CommandCaller<double> travel_{this, "travel", "goes there"};

  int stage_ = 0;
  bool cancelled_ = false;
  CommandHandle journey_{CallStatus::kNotReady};
};

}  // namespace

ARMATURE_COMPONENT_LIBRARY(lift, registry) {
  registry.add<Lift>("Lift", "travels to a height");
  registry.add<Passenger>("Passenger", "makes a tour with a lift");
}
