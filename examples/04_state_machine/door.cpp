// SPDX-License-Identifier: Apache-2.0
// A component whose core is a hierarchical state machine (paper 4, II.C): it takes commands from
// its superior, moves its subordinate, and reacts to its events.
#include <chrono>
#include <utility>

#include "armature/component/author.hpp"

using namespace armature::component;
using namespace std::chrono_literals;

namespace {

/// A motor that pushes the door; it tells when it has reached an end.
class Motor final : public Component {
 public:
  using Component::Component;

 private:
  void push(double speed) { speed_ = speed; }

  Outcome on_start() override {
    updated_ = time();
    return accepted();
  }
  void on_update() override {
    // Not a constant: the deployment says the period.
    const std::chrono::duration<double> elapsed = time() - std::exchange(updated_, time());
    if (speed_ == 0.0) return;
    opening_ += speed_ * elapsed.count();
    if (opening_ >= 1.0 || opening_ <= 0.0) {
      opening_ = opening_ >= 1.0 ? 1.0 : 0.0;
      speed_ = 0.0;
      end_reached_.raise();
    }
  }

  Operation<void(double)> push_{
      this, "push", serve<&Motor::push>, "sets the speed", in_own_thread, args("speed [1/s]")};
  Event<> end_reached_{this, "EndReached", "the door is fully open or fully closed"};

  double opening_ = 0.0;
  double speed_ = 0.0;
  armature::base::Time updated_{};
};

/// Opens on request, waits, closes; opens again if something is in the way.
class Door final : public Component {
 public:
  using Component::Component;

 private:
  void push_open() { move(0.5); }
  void push_shut() { move(-0.25); }
  void halt() { move(0.0); }
  void say_closed() { log_info("closed"); }
  void say_open() { log_info("open"); }
  void say_blocked() { log_info("blocked: opens again"); }

  void move(double speed) {
    if (!push_(speed)) fault("the motor does not answer");
  }

  OperationCaller<void(double)> push_{this, "push", "moves the door"};

  OperationTrigger open_{this, "open", "asks the door to open"};
  OperationTrigger blocked_{this, "blocked", "something is in the way"};
  EventTrigger<> end_reached_{this, "EndReached", "the door stands"};

  StateMachine door_{
      this,
      "door",
      "what the door is doing",
      in_state("Closed", entering<&Door::say_closed>, on(open_, to("Moving"))),
      in_state("Moving", leaving<&Door::halt>,
               in_state("Opening", entering<&Door::push_open>, on(end_reached_, to("Open"))),
               in_state("Closing", entering<&Door::push_shut>, on(end_reached_, to("Closed")),
                        on(blocked_, doing<&Door::say_blocked>, to("Opening")))),
      in_state("Open", entering<&Door::say_open>, after(1s, to("Moving/Closing")))};
};

/// Asks the door to open, and stands in its way once.
class Visitor final : public Component {
 public:
  using Component::Component;

 private:
  void on_update() override {
    ++seconds_;
    if (seconds_ == 1) log_info("asks to enter: {}", open_().value);
    if (seconds_ == 5) log_info("stands in the way: {}", blocked_().value);
    if (seconds_ == 6) log_info("asks again: {}", open_().value);
  }

  OperationCaller<bool()> open_{this, "open", "asks the door to open"};
  OperationCaller<bool()> blocked_{this, "blocked", "stands in the way"};

  int seconds_ = 0;
};

}  // namespace

ARMATURE_COMPONENT_LIBRARY(door, registry) {
  registry.add<Motor>("Motor", "pushes a door");
  registry.add<Door>("Door", "opens, waits and closes");
  registry.add<Visitor>("Visitor", "wants to go through a door");
}
