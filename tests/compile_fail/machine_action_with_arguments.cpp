// SPDX-License-Identifier: Apache-2.0
// expect: an action of a state machine is a member function without arguments
#include "armature/component/author.hpp"

using namespace armature::component;

class Wrong final : public Component {
 public:
  using Component::Component;
  void act(int) {}
  StateMachine mode{this, "mode", "what it does", in_state("On", "works", during<&Wrong::act>)};
};

Component& use() {
  static Wrong wrong("wrong");
  return wrong;
}
