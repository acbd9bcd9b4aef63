// SPDX-License-Identifier: Apache-2.0
// expect: an array in a described type has at least one element
#include <array>

#include "armature/component/author.hpp"

using namespace armature::component;

class Wrong final : public Component {
 public:
  using Component::Component;
  Property<std::array<double, 0>> none{this, "None", {}, "nothing"};
};

Component& use() {
  static Wrong wrong("wrong");
  return wrong;
}
