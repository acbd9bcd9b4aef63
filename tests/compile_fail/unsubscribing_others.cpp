// SPDX-License-Identifier: Apache-2.0
// expect: unsubscribe_all
#include "armature/component/author.hpp"

using namespace armature::component;

class Wrong final : public Component {
 public:
  using Component::Component;

 private:
  void on_update() override { passed_.unsubscribe_all(); }

  Event<> passed_{this, "passed", "something went by"};
};

Component& use() {
  static Wrong wrong("wrong");
  return wrong;
}
