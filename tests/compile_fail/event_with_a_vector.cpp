// SPDX-License-Identifier: Apache-2.0
// expect: vectors go on ports
#include "armature/component/author.hpp"

using namespace armature::component;

class Wrong final : public Component {
 public:
  using Component::Component;
  Event<std::vector<double>> event{this, "Moved", "has moved"};
};

Component& use() {
  static Wrong wrong("wrong");
  return wrong;
}
