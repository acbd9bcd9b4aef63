// SPDX-License-Identifier: Apache-2.0
// The control program of paper 4 (section IV.B), in a process of its own: it keeps the ball in the
// middle of the picture.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <future>

#include "armature/ride/node.hpp"
#include "ball_client.hpp"

namespace {

constexpr float kTurning = 0.002f;  // k1 [m/s per px]
constexpr float kDriving = 0.02f;   // k2
constexpr int kMiddleX = 160;       // x0 of a picture of 320 x 240 pixels [px]
constexpr int kMiddleY = 120;       // y0
constexpr int kNearEnough = 5;      // [px]
constexpr int kPicturesInTheMiddle = 20;

class Pilot {
 public:
  explicit Pilot(ball::ChassisPlaceholder& chassis) : chassis_(chassis) {}

  std::future<void> arrival() { return arrival_.get_future(); }

  void follow(const ball::ObjectPositionEvent& ball) {
    if (arrived_) return;
    const int right = ball.x - kMiddleX;
    const int up = ball.y - kMiddleY;
    const float turn = kTurning * static_cast<float>(right);
    const float drive = kDriving * static_cast<float>(up);
    const auto within = [](float velocity) { return std::clamp(velocity, -1.0f, 1.0f); };
    chassis_.setVelocity(within(drive + turn), within(drive - turn));

    const bool in_the_middle = std::abs(right) < kNearEnough && std::abs(up) < kNearEnough;
    pictures_ = in_the_middle ? pictures_ + 1 : 0;
    if (pictures_ < kPicturesInTheMiddle) return;
    arrived_ = true;
    chassis_.setVelocity(0.0f, 0.0f);
    arrival_.set_value();
  }

 private:
  ball::ChassisPlaceholder& chassis_;
  std::promise<void> arrival_;
  int pictures_ = 0;
  bool arrived_ = false;
};

}  // namespace

int main(int count, char** arguments) {
  armature::ride::Node node;
  armature::ride::Peer& robot = node.connect(count > 1 ? arguments[1] : "tcp://127.0.0.1:4848");
  ball::VSPlaceholder vision(robot, "Vision");
  ball::ChassisPlaceholder chassis(robot, "Chassis");
  const auto connected = robot.wait_until_connected(std::chrono::seconds(5));
  if (!connected) {
    std::fprintf(stderr, "pilot: %s\n", connected.error().c_str());
    return 1;
  }
  const auto ready = vision.initialize();
  if (!ready.ok() || ready.value() != 0) {
    std::fprintf(stderr, "pilot: the camera is not ready: %s\n", ready.error().c_str());
    return 1;
  }
  const auto refused = vision.setThreshold(300, 0, 0);
  std::printf("%s\n", refused.error().c_str());

  Pilot pilot(chassis);
  std::future<void> arrival = pilot.arrival();
  const auto pictures = vision.on_ObjectPositionEvent(
      [&](const ball::ObjectPositionEvent& position) { pilot.follow(position); });
  vision.start();
  // A robot that comes back has a camera that is off.
  const auto changes = robot.on_change([&](const armature::ride::PeerChange& change) {
    if (change.connected) vision.start();
  });
  const bool arrived = arrival.wait_for(std::chrono::seconds(60)) == std::future_status::ready;
  vision.stop();
  std::printf(arrived ? "the ball is in the middle\n" : "the ball was not reached\n");
  return arrived ? 0 : 1;
}
