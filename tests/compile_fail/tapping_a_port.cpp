// SPDX-License-Identifier: Apache-2.0
// expect: tap
#include "armature/component/author.hpp"

using namespace armature::component;

class Wrong final : public Component {
 public:
  using Component::Component;

 private:
  void on_update() override { out_.tap(4); }

  OutputPort<double> out_{this, "Out", "a number"};
};

Component& use() {
  static Wrong wrong("wrong");
  return wrong;
}
