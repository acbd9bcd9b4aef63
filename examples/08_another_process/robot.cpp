// SPDX-License-Identifier: Apache-2.0
// The mobile robot of paper 4: a camera that sees a ball, and a chassis. Here both are simulated.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <thread>

#include "armature/ride/node.hpp"
#include "ball_service.hpp"

namespace {

constexpr std::chrono::milliseconds kPeriod(10);

class Wheels final : public ball::ChassisService {
 public:
  void setVelocity(float left, float right) override {
    left_ = left;
    right_ = right;
  }
  void stop() override { setVelocity(0.0f, 0.0f); }
  float left() const { return left_; }
  float right() const { return right_; }

 private:
  std::atomic<float> left_{0.0f};  // [m/s]
  std::atomic<float> right_{0.0f};
};

class Camera final : public ball::VSService {
 public:
  std::int32_t initialize() override { return 0; }
  std::int32_t setThreshold(std::uint32_t, std::uint32_t, std::uint32_t) override { return 0; }
  void start() override { on_ = true; }
  void stop() override { on_ = false; }

  void see(int x, int y) {
    if (on_) raise(ball::ObjectPositionEvent{x, y});
  }

 private:
  std::atomic<bool> on_{false};
};

/// Where the ball is, seen from the robot.
struct Ball {
  double distance = 3.0;  // [m]
  double bearing = 0.5;   // [rad], to the left

  void move(double left, double right, double seconds) {
    constexpr double kTrack = 0.3;  // between the wheels [m]
    bearing -= (right - left) / kTrack * seconds;
    distance = std::max(0.2, distance - (left + right) / 2 * std::cos(bearing) * seconds);
  }
  /// In a picture of 320 x 240 pixels, from its lower left corner [px].
  int x() const { return static_cast<int>(std::lround(160 - 200 * std::tan(bearing))); }
  int y() const { return static_cast<int>(std::lround(120 + 60 * (distance - 1.0))); }
};

}  // namespace

int main(int count, char** arguments) {
  Camera camera;
  Wheels wheels;
  armature::ride::Node node;
  const auto address = node.listen(count > 1 ? arguments[1] : "tcp://127.0.0.1:4848");
  if (!address) {
    std::fprintf(stderr, "robot: %s\n", address.error().c_str());
    return 1;
  }
  if (!node.add("Vision", camera) || !node.add("Chassis", wheels)) return 1;
  std::printf("the robot is at %s\n", address.value().text().c_str());
  std::fflush(stdout);

  Ball ball;
  for (auto next = std::chrono::steady_clock::now();; std::this_thread::sleep_until(next)) {
    next += kPeriod;
    ball.move(wheels.left(), wheels.right(), std::chrono::duration<double>(kPeriod).count());
    camera.see(ball.x(), ball.y());
  }
}
