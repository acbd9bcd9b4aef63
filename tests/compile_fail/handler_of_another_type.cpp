// SPDX-License-Identifier: Apache-2.0
// expect: a handler of an input port takes (), (value) or (index, value)
#include "armature/component/author.hpp"

using namespace armature::component;

class Wrong final : public Component {
 public:
  using Component::Component;
  void step(const std::string&) {}
  InputPort<double> in{this, "In", "an angle", "rad", on_data<&Wrong::step>};
};

Component& use() {
  static Wrong wrong("wrong");
  return wrong;
}
