// SPDX-License-Identifier: Apache-2.0
// A component that a page shows and commands: nothing in it knows of pages.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "armature/component/author.hpp"

using namespace armature::component;

namespace {

/// Travels at constant speed and says where it is.
class Elevator final : public Component {
 public:
  using Component::Component;

 private:
  Outcome on_start() override {
    updated_ = time();
    return accepted();
  }
  void on_update() override {
    const std::chrono::duration<double> elapsed = time() - std::exchange(updated_, time());
    const double step = speed_ * elapsed.count();
    position_ += std::clamp(target_ - position_, -step, step);
    if (start_ != target_) travel_.report((position_ - start_) / (target_ - start_));
    height_.write(position_);
  }

  double top() { return top_; }

  Outcome begin_travel(double target) {
    if (!(target >= 0.0 && target <= top_)) return refused("the target is outside the shaft");
    start_ = position_;
    target_ = target;
    return accepted();
  }
  bool arrived() { return std::abs(target_ - position_) < 1e-9; }
  void halt() { target_ = position_; }

  Property<double> top_{this, "Top", 3.0, "highest position", "m", range(0.0, 100.0)};
  Property<double> speed_{this, "Speed", 1.0, "of travel", "m/s", range(0.0, 10.0)};
  OutputPort<double> height_{this, "Height", "present position", "m"};
  Operation<double()> get_top_{this, "top", serve<&Elevator::top>, "highest position [m]"};
  Command<double> travel_{this,
                          "travel",
                          serve<&Elevator::begin_travel>,
                          "goes to a height",
                          args("target [m]"),
                          done_when<&Elevator::arrived>,
                          cancelled_by<&Elevator::halt>};

  double position_ = 0.0;
  double start_ = 0.0;
  double target_ = 0.0;
  armature::base::Time updated_{};
};

}  // namespace

ARMATURE_COMPONENT_LIBRARY(elevator, registry) {
  registry.add<Elevator>("Elevator", "travels to a height");
}
