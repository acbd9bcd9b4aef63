// SPDX-License-Identifier: Apache-2.0
// expect: data on ports never grows
#include "armature/component/author.hpp"

using namespace armature::component;

class Wrong final : public Component {
 public:
  using Component::Component;
  InputPort<std::string> in{this, "In", "a text"};
};

Component& use() {
  static Wrong wrong("wrong");
  return wrong;
}
