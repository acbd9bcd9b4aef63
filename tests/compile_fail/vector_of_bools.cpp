// SPDX-License-Identifier: Apache-2.0
// expect: use std::vector<std::uint8_t>
#include "armature/component/author.hpp"

using namespace armature::component;

class Wrong final : public Component {
 public:
  using Component::Component;
  Property<std::vector<bool>> flags{this, "Flags", {}, "flags"};
};

Component& use() {
  static Wrong wrong("wrong");
  return wrong;
}
