// SPDX-License-Identifier: Apache-2.0
// The control law of paper 4 (section IV.B) as a component, for ball.yaml: where the ball is comes
// by a command, and the wheels' speeds are on ports. It knows nothing of other processes.
#include <algorithm>
#include <cstdlib>

#include "armature/component/author.hpp"

using namespace armature::component;

namespace {

/// Keeps the ball in the middle of the picture.
class Steering final : public Component {
 public:
  using Component::Component;

 private:
  Outcome look(int x, int y) {
    const auto within = [](float speed) { return std::clamp(speed, -1.0f, 1.0f); };
    const int right = x - middle_x_;
    const int up = y - middle_y_;
    const float turn = turning_.get() * static_cast<float>(right);
    const float drive = driving_.get() * static_cast<float>(up);
    left_.write(within(drive + turn));
    right_.write(within(drive - turn));
    steered_.raise();
    look_.complete();
    tell(std::abs(right) < kNearEnough && std::abs(up) < kNearEnough);
    return accepted();
  }

  /// Once, when it has stayed in the middle for some pictures.
  void tell(bool in_the_middle) {
    pictures_ = in_the_middle ? pictures_ + 1 : 0;
    if (pictures_ == kPicturesInTheMiddle) log_info("the ball is in the middle");
  }

  static constexpr int kNearEnough = 5;  // [px]
  static constexpr int kPicturesInTheMiddle = 20;

  Property<float> turning_{this, "Turning", 0.002f, "k1: speed of each wheel, m/s for each px"};
  Property<float> driving_{this, "Driving", 0.02f, "k2: the same"};
  Property<int> middle_x_{this, "MiddleX", 160, "x0: where the ball is to be", "px"};
  Property<int> middle_y_{this, "MiddleY", 120, "y0: the same", "px"};
  OutputPort<float> left_{this, "Left", "speed of the left wheel", "m/s"};
  OutputPort<float> right_{this, "Right", "speed of the right wheel", "m/s"};
  Event<> steered_{this, "Steered", "the speeds are new"};
  Command<int, int> look_{this, "look", serve<&Steering::look>,
                          "where the ball is, from the picture's lower left corner",
                          args("x [px]", "y [px]")};
  int pictures_ = 0;
};

}  // namespace

ARMATURE_COMPONENT_LIBRARY(steering, registry) {
  registry.add<Steering>("Steering", "keeps a ball in the middle of the picture");
}
