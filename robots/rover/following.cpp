// SPDX-License-Identifier: Apache-2.0
#include "robots/rover/following.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "robots/rover/numbers.hpp"

namespace armature::rover {
namespace {

constexpr double kWidth = 320.0;  // [px]
constexpr double kHeight = 240.0;
constexpr double kDown = 14.0 * std::numbers::pi / 180.0;
constexpr double kHalfView = 25.0 * std::numbers::pi / 180.0;  // vertical
const double kFocal = 0.5 * kHeight / std::tan(kHalfView);     // [px]
constexpr double kNear = 0.4;                                  // [m]
constexpr double kFar = 4.0;

/// In the camera's frame [m]: to the right, upwards in the picture, along its axis.
struct Seen {
  double right = 0.0;
  double up = 0.0;
  double along = 0.0;
};

struct Point {
  double x = 0.0;
  double y = 0.0;
};

Point camera_of(const View& view) {
  return {view.x + kCameraAhead * std::cos(view.heading),
          view.y + kCameraAhead * std::sin(view.heading)};
}

Seen seen_from_camera(const View& view) {
  const Point camera = camera_of(view);
  const double dx = view.ball_x - camera.x;
  const double dy = view.ball_y - camera.y;
  const double ahead = dx * std::cos(view.heading) + dy * std::sin(view.heading);
  const double left = -dx * std::sin(view.heading) + dy * std::cos(view.heading);
  const double above = view.ball_z - kCameraHeight;
  return {-left, ahead * std::sin(kDown) + above * std::cos(kDown),
          ahead * std::cos(kDown) - above * std::sin(kDown)};
}

/// From where to where an outline reaches in one direction of the picture, of its middle [px].
struct Reach {
  double low = 0.0;
  double high = 0.0;
  double middle() const { return 0.5 * (low + high); }
};

/// The outline of a sphere: the planes through the camera that touch it.
Reach reach(double across, double along) {
  const double angle = std::atan2(across, along);
  const double half = std::asin(std::min(1.0, kBallRadius / std::hypot(across, along)));
  return {kFocal * std::tan(angle - half), kFocal * std::tan(angle + half)};
}

/// What stands on the floor and hides what is behind it, as lines across it.
struct Obstacle {
  Point a;
  Point b;
};
constexpr std::array<Obstacle, 6> kObstacles{{{{2.09, -0.16}, {2.09, 0.16}},
                                              {{2.11, -0.16}, {2.11, 0.16}},
                                              {{2.35, 1.4}, {2.45, 1.4}},
                                              {{2.4, 1.35}, {2.4, 1.45}},
                                              {{2.05, -1.55}, {2.35, -1.25}},
                                              {{2.05, -1.25}, {2.35, -1.55}}}};

double side(const Point& from, const Point& to, const Point& of) {
  return (to.x - from.x) * (of.y - from.y) - (to.y - from.y) * (of.x - from.x);
}

bool crosses(const Point& from, const Point& to, const Obstacle& obstacle) {
  return side(from, to, obstacle.a) * side(from, to, obstacle.b) < 0.0 &&
         side(obstacle.a, obstacle.b, from) * side(obstacle.a, obstacle.b, to) < 0.0;
}

bool is_free(const Point& camera, const Point& point) {
  return std::ranges::none_of(kObstacles,
                              [&](const Obstacle& each) { return crosses(camera, point, each); });
}

/// The obstacles are lower than what a hand carries, which does not matter to where it looks.
InSight behind_obstacles(const View& view) {
  const Point camera = camera_of(view);
  const Point ball{view.ball_x, view.ball_y};
  const double length = std::hypot(ball.x - camera.x, ball.y - camera.y);
  const Point aside{-(ball.y - camera.y) / length, (ball.x - camera.x) / length};
  int free = 0;
  constexpr int kRays = 9;
  for (int k = 0; k < kRays; ++k) {
    const double by = 1.2 * kBallRadius * (2.0 * k / (kRays - 1) - 1.0);
    if (is_free(camera, {ball.x + by * aside.x, ball.y + by * aside.y})) ++free;
  }
  if (free == kRays) return InSight::kWhole;
  return free == 0 ? InSight::kNothing : InSight::kPart;
}

double error_px(const Sight& sight) {
  const PicturePoint really = *truth(sight.view);
  return std::hypot(sight.seen->x - really.x, sight.seen->y - really.y);
}

}  // namespace

double distance(const View& view) {
  const Point camera = camera_of(view);
  return std::hypot(view.ball_x - camera.x, view.ball_y - camera.y);
}

double bearing(const View& view) {
  const Point camera = camera_of(view);
  const double to_ball = std::atan2(view.ball_y - camera.y, view.ball_x - camera.x);
  return std::remainder(to_ball - view.heading, 2.0 * std::numbers::pi);
}

std::optional<PicturePoint> truth(const View& view) {
  const Seen ball = seen_from_camera(view);
  if (ball.along <= kBallRadius) return std::nullopt;
  return PicturePoint{0.5 * kWidth + reach(ball.right, ball.along).middle(),
                      0.5 * kHeight + reach(ball.up, ball.along).middle()};
}

InSight in_sight(const View& view) {
  const Seen ball = seen_from_camera(view);
  if (ball.along <= 2.0 * kBallRadius) return InSight::kNothing;
  const Reach x = reach(ball.right, ball.along);
  const Reach y = reach(ball.up, ball.along);
  const double w = 0.5 * kWidth;
  const double h = 0.5 * kHeight;
  if (x.low > w + 1.0 || x.high < -w - 1.0 || y.low > h + 1.0 || y.high < -h - 1.0) {
    return InSight::kNothing;
  }
  const bool whole = x.low > 1.0 - w && x.high < w - 1.0 && y.low > 1.0 - h && y.high < h - 1.0;
  const InSight hidden = behind_obstacles(view);
  return whole || hidden == InSight::kNothing ? hidden : InSight::kPart;
}

Recognition recognition(std::span<const Sight> sights) {
  Recognition all;
  std::vector<double> errors;
  for (const Sight& sight : sights) {
    if (!sight.judged) continue;
    const InSight in = in_sight(sight.view);
    const double away = distance(sight.view);
    if (in == InSight::kNothing) {
      ++all.none;
      if (sight.seen) ++all.claimed;
    } else if (in == InSight::kWhole && away >= kNear && away <= kFar) {
      ++all.whole;
      if (!sight.seen) continue;
      ++all.found;
      errors.push_back(error_px(sight));
    }
  }
  if (errors.empty()) return all;
  double squares = 0.0;
  for (const double error : errors) squares += error * error;
  all.rms_px = std::sqrt(squares / static_cast<double>(errors.size()));
  std::ranges::sort(errors);
  all.p99_px = errors[errors.size() * 99 / 100];
  return all;
}

bool is_in_a_hand(const View& view) { return view.ball_z > 1.2 * kBallRadius; }

Following following(std::span<const Sight> sights) {
  Following worst;
  worst.nearest_m = 1e9;
  for (const Sight& sight : sights) {
    if (is_in_a_hand(sight.view)) continue;
    const double away = distance(sight.view);
    worst.distance_error_m = std::max(worst.distance_error_m, std::abs(away - kWantedDistance));
    worst.bearing_rad = std::max(worst.bearing_rad, std::abs(bearing(sight.view)));
    worst.nearest_m = std::min(worst.nearest_m, away);
  }
  return worst;
}

StepAnswer step_answer(std::span<const Sight> sights) {
  StepAnswer answer;
  const double first = bearing(sights.front().view);
  for (const Sight& sight : sights) {
    const double now = bearing(sight.view);
    const double past = sight.time_s - sights.front().time_s;
    if (past >= 1.0) answer.after_1_s_rad = std::max(answer.after_1_s_rad, std::abs(now));
    answer.overshoot = std::max(answer.overshoot, -now / first);
  }
  return answer;
}

std::optional<double> found_after(std::span<const Sight> sights, double back) {
  for (const Sight& sight : sights) {
    if (sight.time_s >= back && sight.seen) return sight.time_s - back;
  }
  return std::nullopt;
}

std::vector<Sight> of_phase(std::span<const Sight> sights, int phase, double skip_s,
                            double length_s) {
  std::vector<Sight> chosen;
  std::optional<double> begin;
  for (const Sight& sight : sights) {
    if (sight.phase != phase) continue;
    if (!begin) begin = sight.time_s;
    const double past = sight.time_s - *begin - skip_s;
    if (past >= 0.0 && past <= length_s) chosen.push_back(sight);
  }
  return chosen;
}

}  // namespace armature::rover
