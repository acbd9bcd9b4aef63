// SPDX-License-Identifier: Apache-2.0
// expect: this type has no description
#include "armature/component/author.hpp"

using namespace armature::component;

struct Pose {
  double x;
  double y;
};

class Wrong final : public Component {
 public:
  using Component::Component;
  Property<Pose> pose{this, "Pose", {}, "a pose"};
};

Component& use() {
  static Wrong wrong("wrong");
  return wrong;
}
