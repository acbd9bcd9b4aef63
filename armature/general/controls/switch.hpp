// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/component/author.hpp"

namespace armature::general {

/// Is on or off, as it was turned last; at the start, as the deployment says.
class Switch final : public component::Component {
 public:
  using Component::Component;

 private:
  component::Outcome on_start() override {
    is_on_ = initially_;
    return component::accepted();
  }
  void on_update() override { on_.write(is_on_); }
  void turn(bool on) {
    const bool changed = on != is_on_;
    is_on_ = on;
    on_.write(on);
    if (!changed) return;
    if (on) turned_on_.raise();
    if (!on) turned_off_.raise();
  }

  component::Property<bool> initially_{this, "Initially", false, "whether it is on at the start"};
  component::OutputPort<bool> on_{this, "On", "whether it is on"};
  component::Event<> turned_on_{this, "TurnedOn", "it was off before"};
  component::Event<> turned_off_{this, "TurnedOff", "it was on before"};
  component::Operation<void(bool)> turn_{this,
                                         "turn",
                                         component::serve<&Switch::turn>,
                                         "turns it on or off",
                                         component::in_own_thread,
                                         component::args("on")};
  bool is_on_ = false;
};

}  // namespace armature::general
