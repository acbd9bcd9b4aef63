// SPDX-License-Identifier: Apache-2.0
#include "armature/component/author.hpp"
#include "armature/control/pid.hpp"

namespace {

using armature::component::Component;
using armature::component::Outcome;
using armature::control::Pid;

/// Says how often it was updated.
class Greeter final : public Component {
 public:
  using Component::Component;

 private:
  Outcome on_start() override {
    const armature::base::Result<Pid> made = Pid::make({.kp = 1.0, .u_min = -1.0, .u_max = 1.0});
    return made ? armature::component::accepted() : armature::component::refused(made.error());
  }
  void on_update() override { greetings_.write(++count_); }

  double count_ = 0.0;
  armature::component::OutputPort<double> greetings_{this, "Greetings", "updates until now"};
};

}  // namespace

ARMATURE_COMPONENT_LIBRARY(greeter, registry) {
  registry.add<Greeter>("Greeter", "counts its updates");
}
