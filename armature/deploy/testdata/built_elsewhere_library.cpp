// SPDX-License-Identifier: Apache-2.0
#include "armature/can/frame.hpp"
#include "armature/component/author.hpp"

namespace {

/// Needs a library of Armature that the program did not load.
class Sender final : public armature::component::Component {
 public:
  using Component::Component;

 private:
  void on_update() override {
    bits_.write(armature::can::frame_bits(armature::can::data_frame(1, {})));
  }

  armature::component::OutputPort<double> bits_{this, "Bits", "length of an empty frame"};
};

}  // namespace

ARMATURE_COMPONENT_LIBRARY(built_elsewhere, registry) {
  registry.add<Sender>("Sender", "counts bits");
}
