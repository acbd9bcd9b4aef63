// SPDX-License-Identifier: Apache-2.0
// expect: a command is served by Outcome f(arguments of the command)
#include "armature/component/author.hpp"

using namespace armature::component;

class Wrong final : public Component {
 public:
  using Component::Component;
  void move(double) {}
  Command<double> command{this, "move", serve<&Wrong::move>, "moves"};
};

Component& use() {
  static Wrong wrong("wrong");
  return wrong;
}
