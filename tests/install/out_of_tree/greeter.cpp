// SPDX-License-Identifier: Apache-2.0
#include "armature/component/author.hpp"

namespace {

using armature::component::Component;

/// Says how often it was updated.
class Greeter final : public Component {
 public:
  using Component::Component;

 private:
  void on_update() override { greetings_.write(++count_); }

  double count_ = 0.0;
  armature::component::OutputPort<double> greetings_{this, "Greetings", "updates until now"};
};

}  // namespace

ARMATURE_COMPONENT_LIBRARY(greeter, registry) {
  registry.add<Greeter>("Greeter", "counts its updates");
}
