// SPDX-License-Identifier: Apache-2.0
// A superior gives tasks to its subordinates and answers their failures; of two behaviours that
// want to move the robot the more urgent one does (paper 4, section II.C and figure 3). No
// component names another one: what commands whom is in the deployment.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <string_view>
#include <tuple>
#include <utility>

#include "armature/component/author.hpp"

using namespace armature::component;
using namespace std::chrono_literals;

namespace {

using Why = armature::base::FixedText<127>;

/// The robot on its way, which somebody stands in from the second to the ninth second.
class Body final : public Component {
 public:
  using Component::Component;

 private:
  Outcome on_start() override {
    began_ = updated_ = time();
    return accepted();
  }
  void on_update() override {
    const std::chrono::duration<double> elapsed = time() - std::exchange(updated_, time());
    place_ += speed_.read().value * elapsed.count();
    const auto age = time() - began_;
    const bool in_the_way = age > 2s && age < 9s;
    here_.write(place_);
    free_.write(in_the_way && place_ < 1.2 ? 1.2 - place_ : 10.0);
  }

  InputPort<double> speed_{this, "Speed", "how fast it moves", "m/s"};
  OutputPort<double> here_{this, "Place", "where it is", "m"};
  OutputPort<double> free_{this, "Free", "how far the way is free", "m"};
  double place_ = 0.0;
  armature::base::Time began_{};
  armature::base::Time updated_{};
};

/// A behaviour: goes where it is told to, and gives up after a while.
class Travel final : public Component {
 public:
  using Component::Component;

 private:
  Outcome begin(double target) {
    target_ = target;
    began_ = time();
    return accepted();
  }
  void on_update() override {
    const double left = target_ - place_.read().value;
    wish_.write(go_.active() ? std::clamp(left, -0.5, 0.5) : 0.0);
    if (go_.active() && time() - began_ > 7s) go_.fail("the way is not free");
  }
  bool is_there() { return std::abs(target_ - place_.read().value) < 0.02; }

  InputPort<double> place_{this, "Place", "where the robot is", "m"};
  OutputPort<double> wish_{this, "Wish", "how fast it would move", "m/s"};
  Command<double> go_{this,
                      "goTo",
                      serve<&Travel::begin>,
                      "goes to a place",
                      args("place [m]"),
                      done_when<&Travel::is_there>};
  double target_ = 0.0;
  armature::base::Time began_{};
};

/// A behaviour: keeps away from what is near.
class Avoid final : public Component {
 public:
  using Component::Component;

 private:
  void look(double free) {
    wish_.write(free < 0.3 ? -0.2 : 0.0);
    urgent_.write(free < 0.4);
  }

  InputPort<double> free_{this, "Free", "how far the way is free", "m", on_data<&Avoid::look>};
  OutputPort<double> wish_{this, "Wish", "how fast it would move", "m/s"};
  OutputPort<bool> urgent_{this, "Urgent", "nothing else counts now"};
};

/// Lets the urgent behaviour move the robot, else the other one.
class Arbiter final : public Component {
 public:
  using Component::Component;

 private:
  void choose() {
    const bool urgent = urgent_.read().value;
    speed_.write(urgent ? avoiding_.read().value : travelling_.read().value);
    if (urgent != std::exchange(was_urgent_, urgent)) log_info(urgent ? "keeps away" : "goes on");
  }

  InputPort<bool> urgent_{this, "Urgent", "the urgent behaviour moves the robot"};
  InputPort<double> avoiding_{this, "Avoiding", "its wish", "m/s"};
  InputPort<double> travelling_{this, "Travelling", "the wish of the other one", "m/s",
                                on_data<&Arbiter::choose>};
  OutputPort<double> speed_{this, "Speed", "for the robot", "m/s"};
  bool was_urgent_ = false;
};

/// Does not hold what it takes for the first time.
class Gripper final : public Component {
 public:
  using Component::Component;

 private:
  Outcome close() {
    began_ = time();
    return accepted();
  }
  void on_update() override {
    if (!grasp_.active() || time() - began_ < 500ms) return;
    if (++attempts_ == 1) return grasp_.fail("it slipped");
    grasp_.complete();
  }

  Command<> grasp_{this, "grasp", serve<&Gripper::close>, "takes what is there"};
  int attempts_ = 0;
  armature::base::Time began_{};
};

/// Fetches something: the superior. Its events are tasks, and what comes back are events.
class Courier final : public Component {
 public:
  using Component::Component;

 private:
  void go_to_shelf() { go(2.0); }
  void go_home() { go(0.0); }
  void go(double place) {
    log_info("goes to {} m", place);
    go_.raise(place);
  }
  void take() {
    log_info("grasps");
    take_.raise();
  }
  void say_stuck() { log_info("stuck: {}", std::get<0>(stuck_.arguments()).view()); }
  void say_slipped() { log_info("failed: {}", std::get<0>(slipped_.arguments()).view()); }
  void say_done() { log_info("has fetched it"); }

  Event<double> go_{this, "Go", "a place to go to", {"place [m]"}};
  Event<> take_{this, "Take", "take what is there"};
  EventTrigger<> arrived_{this, "Arrived", "the robot is there"};
  EventTrigger<Why> stuck_{this, "Stuck", "the robot does not get there"};
  EventTrigger<> held_{this, "Held", "it is in the gripper"};
  EventTrigger<Why> slipped_{this, "Slipped", "it is not"};

  StateMachine task_{
      this,
      "task",
      "what it does",
      in_state("Waiting", after(500ms, to("ToShelf"))),
      in_state("ToShelf", entering<&Courier::go_to_shelf>, on(arrived_, to("Grasping")),
               on(stuck_, doing<&Courier::say_stuck>, to("Resting"))),
      in_state("Resting", after(1s, to("ToShelf"))),
      in_state("Grasping", entering<&Courier::take>, on(held_, to("Home")),
               on(slipped_, doing<&Courier::say_slipped>, to("Grasping"))),
      in_state("Home", entering<&Courier::go_home>, on(arrived_, to("Done")),
               on(stuck_, doing<&Courier::say_stuck>, to("Home"))),
      in_state("Done", entering<&Courier::say_done>)};
};

}  // namespace

ARMATURE_COMPONENT_LIBRARY(courier, registry) {
  registry.add<Body>("Body", "a robot on its way", Granularity::kAtomic);
  registry.add<Travel>("Travel", "goes somewhere");
  registry.add<Avoid>("Avoid", "keeps away from what is near");
  registry.add<Arbiter>("Arbiter", "lets one of two behaviours move the robot");
  registry.add<Gripper>("Gripper", "takes things", Granularity::kAtomic);
  registry.add<Courier>("Courier", "fetches things", Granularity::kApplication);
}
