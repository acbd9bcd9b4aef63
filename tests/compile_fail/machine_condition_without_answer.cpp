// SPDX-License-Identifier: Apache-2.0
// expect: a condition of a state machine is bool f() of the component
#include "armature/component/author.hpp"

using namespace armature::component;

class Wrong final : public Component {
 public:
  using Component::Component;
  void ready() {}
  StateMachine mode{this, "mode", "what it does",
                    in_state("Off", "waits", when<&Wrong::ready>(to("On"))),
                    in_state("On", "works")};
};

Component& use() {
  static Wrong wrong("wrong");
  return wrong;
}
