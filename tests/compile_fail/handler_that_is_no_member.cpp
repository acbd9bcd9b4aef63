// SPDX-License-Identifier: Apache-2.0
// expect: name a member function of the component
#include "armature/component/author.hpp"

using namespace armature::component;

void step(double) {}

class Wrong final : public Component {
 public:
  using Component::Component;
  InputPort<double> in{this, "In", "an angle", "rad", on_data<&step>};
};

Component& use() {
  static Wrong wrong("wrong");
  return wrong;
}
