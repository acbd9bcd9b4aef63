// SPDX-License-Identifier: Apache-2.0
// expect nothing: what the other files have wrong is right here, so that they fail for their own
// mistake.
#include <array>
#include <cstdint>
#include <vector>

#include "armature/component/author.hpp"

using namespace armature::component;

struct Pose {
  double x;
  double y;
};
ARMATURE_STRUCT(Pose, (x, "m"), y);

class Right final : public Component {
 public:
  using Component::Component;
  void step(double) {}
  double read(int) { return 0.0; }
  Outcome move(double) { return accepted(); }
  void act() {}
  bool ready() { return true; }
  OutputPort<Pose> pose_out{this, "PoseOut", "a pose"};
  OutputPort<armature::base::FixedText<8>> text_out{this, "TextOut", "a text"};
  Property<Pose> pose{this, "Pose", {}, "a pose"};
  Property<std::vector<std::uint8_t>> flags{this, "Flags", {}, "flags"};
  Property<std::array<double, 1>> one{this, "One", {}, "one number"};
  InputPort<double> in{this, "In", "an angle", "rad", on_data<&Right::step>};
  Operation<double(int)> operation{this, "read", serve<&Right::read>, "reads"};
  Command<double> command{this, "move", serve<&Right::move>, "moves"};
  Event<double> event{this, "Moved", "has moved"};
  EventHandler<double> handler{this, "Moved", serve<&Right::step>, "takes it"};
  StateMachine mode{this, "mode", "what it does",
                    in_state("Off", "waits", when<&Right::ready>(to("On"))),
                    in_state("On", "works", during<&Right::act>)};
};

Component& use() {
  static Right right("right");
  return right;
}
