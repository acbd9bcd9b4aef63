// SPDX-License-Identifier: Apache-2.0
// The parts of a chassis (paper 4, II.A): atomic components for wheels, an algorithm that mixes
// speed and turn, and a driver. chassis.yaml assembles a composite of them, without C++.
#include "armature/component/author.hpp"

using namespace armature::component;

namespace {

/// Atomic: one wheel. Counts how far it has turned.
class Wheel final : public Component {
 public:
  using Component::Component;

 private:
  void turn(double speed) {
    travelled_ += speed / radius_ * kPeriod;
    angle_.write(travelled_);
  }

  static constexpr double kPeriod = 0.01;  // s, as chassis.yaml has it

  Property<double> radius_{this, "Radius", 0.1, "of the wheel", "m", range(0.01, 2.0)};
  InputPort<double> speed_{this, "Speed", "at the rim", "m/s", on_data<&Wheel::turn>};
  OutputPort<double> angle_{this, "Angle", "turned since the start", "rad"};

  double travelled_ = 0.0;
};

/// Algorithm: two wheel speeds of a forward speed and a turn rate.
class Mixer final : public Component {
 public:
  using Component::Component;

 private:
  void mix(double forward) {
    const double difference = turn_.read().value * track_ / 2.0;
    left_.write(forward - difference);
    right_.write(forward + difference);
  }

  Property<double> track_{this, "Track", 0.5, "distance of the wheels", "m", range(0.01, 10.0)};
  InputPort<double> turn_{this, "Turn", "turn rate", "rad/s"};
  InputPort<double> forward_{this, "Forward", "speed", "m/s", on_data<&Mixer::mix>};
  OutputPort<double> left_{this, "Left", "speed of the left wheel", "m/s"};
  OutputPort<double> right_{this, "Right", "speed of the right wheel", "m/s"};
};

/// Application: drives a quarter circle and says how far each wheel has turned.
class Driver final : public Component {
 public:
  using Component::Component;

 private:
  void on_update() override {
    turn_.write(1.0);
    forward_.write(1.0);
    if (++cycles_ % 50 == 0) {
      log_info("wheels have turned {} and {} rad", left_.read().value, right_.read().value);
    }
  }

  InputPort<double> left_{this, "Left", "angle of the left wheel", "rad"};
  InputPort<double> right_{this, "Right", "angle of the right wheel", "rad"};
  OutputPort<double> forward_{this, "Forward", "speed", "m/s"};
  OutputPort<double> turn_{this, "Turn", "turn rate", "rad/s"};

  int cycles_ = 0;
};

}  // namespace

ARMATURE_COMPONENT_LIBRARY(chassis, registry) {
  registry.add<Wheel>("Wheel", "one wheel");
  registry.add<Mixer>("Mixer", "wheel speeds of speed and turn rate");
  registry.add<Driver>("Driver", "drives a quarter circle");
}
