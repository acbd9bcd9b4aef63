// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/sim/ray_camera.hpp"
#include "robots/rover/ball.hpp"
#include "robots/rover/simulated_rover.hpp"

namespace armature::rover {

/// What a camera that fails does, for tests of faults.
enum class CameraFault : std::uint8_t {
  kNone,
  kFrozen,  ///< the same image again and again
  kGone,    ///< no image any more
};
ARMATURE_ENUM(CameraFault, kNone, kFrozen, kGone);

/// Of an image: where rover and ball were. Whoever judges what was seen compares with it.
struct View {
  double x = 0.0;
  double y = 0.0;
  double heading = 0.0;
  double ball_x = 0.0;
  double ball_y = 0.0;
  double ball_z = 0.0;
};
ARMATURE_STRUCT(View, (x, "m", "of the rover, as of Place"), (y, "m"), (heading, "rad"),
                (ball_x, "m", "of the ball's middle"), (ball_y, "m"), (ball_z, "m"));

/// The camera on the rover's mast: an image in each of its cycles, of where rover and ball were
/// said to be last (sim::RayCamera). Give it an activity of its own, `{periodic: 50 ms}` without
/// priority: an image takes milliseconds, in which nobody else waits.
///
/// The rover counts as level: its pitch and roll are not in `Place`.
/// @rt nonblocking, no allocation, but milliseconds
class Camera final : public component::Component {
 public:
  using Component::Component;

 private:
  component::Outcome on_configure() override;
  component::Outcome on_start() override;
  void on_update() override;
  View place_bodies();

  component::Property<int> width_{
      this, "ImageWidth", 320, "pixels of a row", "", component::range(16, 4096)};
  component::Property<int> height_{
      this, "ImageHeight", 240, "rows", "", component::range(16, 4096)};
  component::Property<double> noise_{this, "Noise",
                                     2.0,  "standard deviation of each channel, of 255 levels",
                                     "",   component::range(0.0, 64.0)};
  component::Property<int> seed_{this,           "Seed", 1,
                                 "of the noise", "",     component::range(0, 1'000'000'000)};
  component::Property<CameraFault> fault_{this,
                                          "Fault",
                                          CameraFault::kNone,
                                          "what it does instead of its work",
                                          "",
                                          component::changeable_while_running};
  component::InputPort<Place> rover_{this, "Place", "where the rover is", "",
                                     component::on_lost(component::Reaction::kHold)};
  component::InputPort<BallPoint> ball_{this, "Ball", "where the ball's middle is", "",
                                        component::on_lost(component::Reaction::kHold)};
  component::OutputPort<std::vector<std::uint8_t>> image_{
      this, "Image", "red, green, blue of each pixel, row 0 on top"};
  component::OutputPort<View> view_{this, "View", "where rover and ball were in the image"};
  component::Attribute<int> images_{this, "images", 0, "since the start"};

  std::optional<sim::RayCamera> camera_;
  std::size_t rover_body_ = 0;
  std::size_t ball_body_ = 0;
  std::vector<std::uint8_t> picture_;
};

}  // namespace armature::rover
