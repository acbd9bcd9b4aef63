// SPDX-License-Identifier: Apache-2.0
// expect: begin_from
#include "armature/component/author.hpp"

using namespace armature::component;

class Wrong final : public Component {
 public:
  using Component::Component;

 private:
  void on_update() override { static_cast<void>(travel_.begin_from(nullptr, nullptr)); }
  Outcome travel() { return accepted(); }

  Command<> travel_{this, "travel", serve<&Wrong::travel>, "travels"};
};

Component& use() {
  static Wrong wrong("wrong");
  return wrong;
}
