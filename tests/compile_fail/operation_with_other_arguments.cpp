// SPDX-License-Identifier: Apache-2.0
// expect: the member function does not fit the signature of the operation
#include "armature/component/author.hpp"

using namespace armature::component;

class Wrong final : public Component {
 public:
  using Component::Component;
  double read(const std::string&) { return 0.0; }
  Operation<double(int)> operation{this, "read", serve<&Wrong::read>, "reads"};
};

Component& use() {
  static Wrong wrong("wrong");
  return wrong;
}
