// SPDX-License-Identifier: Apache-2.0
#pragma once

// What the tests of the library ros2 have beside it.

#include <atomic>
#include <chrono>
#include <string>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/controllers/forward_kinematics/pose.hpp"
#include "walk.hpp"

namespace armature::ros2 {

/// Ports that a test writes and reads.
class Numbers final : public component::Component {
 public:
  using Component::Component;

 private:
  component::Outcome on_configure() override {
    Hike hike;
    hike.between.resize(2);
    hike.numbers.resize(3);
    hike_.set_sample(hike);
    position_.set_sample({0.0, 0.0});
    velocity_.set_sample({0.0, 0.0});
    effort_.set_sample({0.0, 0.0});
    image_.set_sample(std::vector<std::uint8_t>(2 * 2 * 3));
    return component::accepted();
  }
  void on_update() override {
    if (const auto walk = walk_in_.read(); walk.is_new()) walk_.write(walk.value);
    if (const auto wanted = wanted_.read(); wanted.is_new()) position_.write(wanted.value);
  }

  component::OutputPort<std::vector<double>> position_{this, "Position", "of two joints", "rad"};
  component::OutputPort<std::vector<double>> velocity_{this, "Velocity", "of two joints", "rad/s"};
  component::OutputPort<std::vector<double>> effort_{this, "Effort", "of two joints", "Nm"};
  component::OutputPort<controllers::Pose> pose_{this, "Pose", "of a tool"};
  component::OutputPort<double> x_{this, "X", "of a chassis", "m"};
  component::OutputPort<double> heading_{this, "Heading", "of a chassis", "rad"};
  component::OutputPort<std::vector<std::uint8_t>> image_{this, "Image", "two by two pixels"};
  component::OutputPort<Hike> hike_{this, "Hike", "of all kinds of types"};
  component::OutputPort<Walk> walk_{this, "Walk", "that came"};
  component::InputPort<Walk> walk_in_{this,
                                      "WalkIn",
                                      "of all kinds of types but vectors",
                                      "",
                                      component::may_stay_open,
                                      component::max_age(std::chrono::seconds(10))};
  component::InputPort<Hike> hike_in_{this, "HikeIn", "with vectors inside", "",
                                      component::may_stay_open};
  component::InputPort<std::vector<double>> any_{this, "Any", "of any number", "",
                                                 component::may_stay_open};
  component::InputPort<double> voltage_{this, "Voltage", "an effort", "V",
                                        component::may_stay_open};
  component::InputPort<std::vector<double>> wanted_{this,
                                                    "Wanted",
                                                    "of two joints",
                                                    "rad",
                                                    component::fixed_size(2),
                                                    component::may_stay_open,
                                                    component::max_age(std::chrono::seconds(10))};
};

/// Stands for Arming.
class Operator final : public component::Component {
 public:
  using Component::Component;

 private:
  void arm() { arm_.raise(); }
  void stop_robot() { stop_.raise(); }
  void disarm_robot() { disarm_.raise(); }

  component::Event<> arm_{this, "Arm", "armed", component::occasional};
  component::Event<> disarm_{this, "Disarm", "disarmed", component::occasional};
  component::Event<> stop_{this, "Stop", "stopped", component::occasional};
  component::Operation<void()> do_arm_{this, "arm", component::serve<&Operator::arm>, "arms",
                                       component::in_own_thread};
  component::Operation<void()> do_stop_{this, "stop", component::serve<&Operator::stop_robot>,
                                        "stops", component::in_own_thread};
  component::Operation<void()> do_disarm_{this, "disarm", component::serve<&Operator::disarm_robot>,
                                          "disarms", component::in_own_thread};
};

/// Passes a number on. It takes commands, but no motion is one of them: it keeps no limits.
class Relay final : public component::Component {
 public:
  using Component::Component;

 private:
  void pass(double value) {
    out_.write(value);
    came_.raise();
  }
  component::Outcome accept() { return component::accepted(); }

  component::InputPort<double> in_{
      this, "In", "a number", "", component::on_data<&Relay::pass>, component::may_stay_open};
  component::OutputPort<double> out_{this, "Out", "the same"};
  component::Event<> came_{this, "Came", "a number"};
  component::Command<> select_{this, "select", component::serve<&Relay::accept>, "selects it"};
};

/// A chassis: it brakes at the operator's stop, if it is told of it.
class Base final : public component::Component {
 public:
  using Component::Component;

 private:
  void follow(double speed) { volts_.write(speed); }
  void brake() { volts_.write(0.0); }
  component::Outcome drive() { return component::accepted(); }

  component::InputPort<double> speed_{
      this, "Speed", "wanted", "m/s", component::on_data<&Base::follow>, component::may_stay_open};
  component::OutputPort<double> volts_{this, "Volts", "of its motor", "V"};
  component::EventHandler<> stop_{this, "Stop", component::serve<&Base::brake>, "brakes",
                                  component::optional};
  component::Command<> drive_{this, "drive", component::serve<&Base::drive>, "drives"};
};

/// Stands for a generator of two joints that plays paths.
class Player final : public component::Component {
 public:
  using Component::Component;

 private:
  using Vector = std::vector<double>;

  component::Outcome on_configure() override {
    desired_.set_sample(present_);
    return component::accepted();
  }
  void on_update() override { desired_.write(present_); }
  component::Outcome play(const Vector& /*path*/, double /*speed*/) {
    return component::accepted();
  }
  void brake() {}

  const Vector present_{0.0, 0.0};
  component::Property<Vector> lower_{this, "lower", {-1.0}, "of each joint", "rad"};
  component::Property<Vector> upper_{this, "upper", {1.0}, "of each joint", "rad"};
  component::OutputPort<Vector> desired_{this, "nAxesDesiredPosition", "of two joints", "rad"};
  component::Command<const Vector&, double> play_{this, "playPath", component::serve<&Player::play>,
                                                  "plays a path"};
  component::EventHandler<> stop_{this, "Stop", component::serve<&Player::brake>, "brakes",
                                  component::optional};
};

/// Stands for a joint: the operator alone has it home.
class Axis final : public component::Component {
 public:
  using Component::Component;

 private:
  void follow(double position) { volts_.write(position); }
  component::Outcome begin() { return component::accepted(); }

  component::InputPort<double> wanted_{this,
                                       "Wanted",
                                       "position",
                                       "rad",
                                       component::on_data<&Axis::follow>,
                                       component::may_stay_open};
  component::OutputPort<double> volts_{this, "Volts", "of its motor", "V"};
  component::Command<> home_{this, "home", component::serve<&Axis::begin>, "homes",
                             component::by_operator};
};

/// Makes a voltage of a number.
class Amplifier final : public component::Component {
 public:
  using Component::Component;

 private:
  void amplify(double value) { out_.write(2.0 * value); }
  void give() { out_.write(1.0); }

  component::InputPort<double> in_{this,
                                   "In",
                                   "a number",
                                   "",
                                   component::on_data<&Amplifier::amplify>,
                                   component::may_stay_open};
  component::EventHandler<> came_{this, "Came", component::serve<&Amplifier::give>, "gives 1 V",
                                  component::optional};
  component::OutputPort<double> out_{this, "Out", "twice that", "V"};
};

/// Writes {1, 0}, {2, 0}, ... in each of its cycles, once it is told to.
class Ticker final : public component::Component {
 public:
  using Component::Component;

 private:
  component::Outcome on_configure() override {
    position_.set_sample(numbers_);
    return component::accepted();
  }
  void on_update() override {
    if (numbers_[0] >= count_) return;
    numbers_[0] += 1.0;
    position_.write(numbers_);
  }

  component::Property<double> count_{
      this, "count", 0.0, "samples that it writes", "", component::changeable_while_running};
  component::OutputPort<std::vector<double>> position_{this, "Position", "counts", "rad"};
  std::vector<double> numbers_{0.0, 0.0};
};

/// Looks at what comes: its number, and the wall clock when it was sent [s].
class Listener final : public component::Component {
 public:
  using Component::Component;

 private:
  component::Outcome on_configure() override {
    late_s_.reserve(100000);
    return component::accepted();
  }
  void on_data(const std::vector<double>& data) {
    const double now =
        std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
    if (data[0] != last_ + 1.0) gaps_.assign(gaps_ + 1);
    last_ = data[0];
    late_s_.push_back(now - data[1]);
    came_.assign(came_ + 1);
  }
  std::vector<double> latencies() { return late_s_; }

  component::Attribute<int> came_{this, "Came", 0, "samples"};
  component::Attribute<int> gaps_{this, "Gaps", 0, "in their numbers"};
  component::InputPort<std::vector<double>> in_{this, "In", "number and time", "",
                                                component::on_data<&Listener::on_data>};
  component::Operation<std::vector<double>()> latencies_{
      this, "latencies", component::serve<&Listener::latencies>, "[s]", component::in_own_thread};
  std::vector<double> late_s_{};
  double last_ = 0.0;
};

}  // namespace armature::ros2
