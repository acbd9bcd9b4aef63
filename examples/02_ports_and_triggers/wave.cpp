// SPDX-License-Identifier: Apache-2.0
// Data flows through ports: a periodic source, a filter that runs whenever data arrives, and a
// watcher that looks at the newest value at its own pace.
#include <cmath>

#include "armature/component/author.hpp"

using namespace armature::component;

namespace {

/// Writes a sine of time, one sample in each cycle.
class Source final : public Component {
 public:
  using Component::Component;

 private:
  void on_update() override {
    const double seconds = std::chrono::duration<double>(time().time_since_epoch()).count();
    position_.write(amplitude_ * std::sin(2.0 * kPi * frequency_ * seconds));
  }

  static constexpr double kPi = 3.14159265358979323846;

  Property<double> amplitude_{this, "Amplitude", 1.0, "of the wave", "rad"};
  Property<double> frequency_{this, "Frequency", 1.0, "of the wave", "Hz", range(0.0, 50.0)};
  OutputPort<double> position_{this, "Position", "the wave", "rad"};
};

/// First-order low-pass: runs on every sample that arrives, in whichever thread brings it.
class LowPass final : public Component {
 public:
  using Component::Component;

 private:
  Outcome on_start() override {
    state_ = 0.0;
    return accepted();
  }

  void step(double measured) {
    state_ += weight_ * (measured - state_);
    filtered_.write(state_);
  }

  Property<double> weight_{
      this, "Weight", 0.1, "of a new sample", "", range(0.0, 1.0), changeable_while_running};
  InputPort<double> raw_{this, "Raw", "what is filtered", "rad", on_data<&LowPass::step>};
  OutputPort<double> filtered_{this, "Filtered", "the smooth part", "rad"};

  double state_ = 0.0;
};

/// Reads the newest value at its own pace, and tells old from new.
class Watcher final : public Component {
 public:
  using Component::Component;

 private:
  void on_update() override {
    const auto reading = value_.read();
    if (!reading) return;
    log_info("{} rad ({}); so far {} values came and went unseen", reading.value,
             name_of(reading.status), value_.counters().missed);
  }

  InputPort<double> value_{this, "Value", "what is watched", "rad"};
};

}  // namespace

ARMATURE_COMPONENT_LIBRARY(wave, registry) {
  registry.add<Source>("Source", "a sine of time");
  registry.add<LowPass>("LowPass", "first-order low-pass filter");
  registry.add<Watcher>("Watcher", "logs the newest value");
}
