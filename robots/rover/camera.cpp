// SPDX-License-Identifier: Apache-2.0
#include "robots/rover/camera.hpp"

#include <cmath>
#include <utility>

#include "robots/rover/description.hpp"
#include "robots/rover/numbers.hpp"

namespace armature::rover {

using component::Outcome;

Outcome Camera::on_configure() {
  // How many wheels there are, is not seen.
  auto made = sim::RayCamera::parse(description(2), "rover",
                                    {.camera = "eye",
                                     .width = width_,
                                     .height = height_,
                                     .noise = noise_,
                                     .seed = static_cast<std::uint64_t>(seed_.get())});
  if (!made) return component::refused(made.error());
  camera_.emplace(std::move(made).value());
  rover_body_ = camera_->find_body("rover").value();
  ball_body_ = camera_->find_body("ball").value();
  picture_.assign(camera_->size(), 0);
  image_.set_sample(picture_);
  return component::accepted();
}

Outcome Camera::on_start() {
  images_.assign(0);
  return component::accepted();
}

void Camera::on_update() {
  if (fault_ == CameraFault::kGone) return;
  if (fault_ != CameraFault::kFrozen) {
    view_.write(place_bodies());
    images_.assign(images_ + 1);
    camera_->render(static_cast<std::uint64_t>(images_.get()), picture_);
  }
  image_.write(picture_);
}

View Camera::place_bodies() {
  View view;
  const auto rover = rover_.read();
  if (rover) {
    view.x = rover.value.x;
    view.y = rover.value.y;
    view.heading = rover.value.heading;
    const double half = 0.5 * rover.value.heading;
    camera_->place(rover_body_, {{rover.value.x, rover.value.y, kWheelRadius},
                                 {std::cos(half), 0.0, 0.0, std::sin(half)}});
  }
  const auto ball = ball_.read();
  if (ball) {
    view.ball_x = ball.value.x;
    view.ball_y = ball.value.y;
    view.ball_z = ball.value.z;
    camera_->place(ball_body_, {{ball.value.x, ball.value.y, ball.value.z}, {1.0, 0.0, 0.0, 0.0}});
  }
  return view;
}

}  // namespace armature::rover
