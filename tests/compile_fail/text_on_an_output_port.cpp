// SPDX-License-Identifier: Apache-2.0
// expect: data on ports never grows
#include "armature/component/author.hpp"

using namespace armature::component;

class Wrong final : public Component {
 public:
  using Component::Component;
  OutputPort<std::string> out{this, "Out", "a text"};
};

Component& use() {
  static Wrong wrong("wrong");
  return wrong;
}
