// SPDX-License-Identifier: Apache-2.0
// expect: the member function does not take the arguments of the event
#include "armature/component/author.hpp"

using namespace armature::component;

class Wrong final : public Component {
 public:
  using Component::Component;
  void take(const std::string&) {}
  EventHandler<double> handler{this, "Moved", serve<&Wrong::take>, "takes it"};
};

Component& use() {
  static Wrong wrong("wrong");
  return wrong;
}
