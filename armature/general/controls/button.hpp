// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/component/author.hpp"

namespace armature::general {

/// Something to press: by an operator, a script, or another component.
class Button final : public component::Component {
 public:
  using Component::Component;

 private:
  void press() { pressed_.raise(); }

  component::Event<> pressed_{this, "Pressed", "somebody pressed it"};
  component::Operation<void()> press_{this, "press", component::serve<&Button::press>,
                                      "raises Pressed", component::in_own_thread};
};

}  // namespace armature::general
