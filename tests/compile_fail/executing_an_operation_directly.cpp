// SPDX-License-Identifier: Apache-2.0
// expect: execute_by_message
#include "armature/component/author.hpp"

using namespace armature::component;

class Wrong final : public Component {
 public:
  using Component::Component;

 private:
  void on_update() override { brake_.execute_by_message(nullptr, nullptr); }
  void brake() {}

  Operation<void()> brake_{this, "brake", serve<&Wrong::brake>, "brakes"};
};

Component& use() {
  static Wrong wrong("wrong");
  return wrong;
}
