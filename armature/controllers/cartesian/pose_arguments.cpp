// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/cartesian/pose_arguments.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "armature/base/quoted.hpp"

namespace armature::controllers {

using control::Pose;

namespace {

constexpr std::size_t kNumbersOfAPose = 6;
constexpr double kLongestJog = 1.0;    // m
constexpr double kFurthestTurn = 2.5;  // rad: a line turns the shorter way round
constexpr double kWayOfATurn = 0.1;    // m for each rad, as PosePath has it

/// A turn of 2.5 rad about an axis, in the axes in which it is given.
std::array<double, 9> turned(int axis, double angle) {
  control::PoseNumbers numbers{};
  numbers[static_cast<std::size_t>(axis)] = angle;
  return control::pose_of(numbers).rotation;
}

std::array<double, 9> product(const std::array<double, 9>& left,
                              const std::array<double, 9>& right) {
  std::array<double, 9> all{};
  for (std::size_t i = 0; i < 9; ++i) {
    for (std::size_t k = 0; k < 3; ++k) all[i] += left[3 * (i / 3) + k] * right[3 * k + i % 3];
  }
  return all;
}

}  // namespace

base::Result<std::vector<Pose>> read_poses_of(const std::vector<double>& numbers) {
  if (numbers.empty() || numbers.size() % kNumbersOfAPose != 0) {
    return base::Error{"found " + std::to_string(numbers.size()) +
                       " numbers, expected six for each pose: x y z roll pitch yaw"};
  }
  if (!std::ranges::all_of(numbers, [](double number) { return std::isfinite(number); })) {
    return base::Error{"a number of the pose is not finite"};
  }
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < numbers.size(); i += kNumbersOfAPose) {
    control::PoseNumbers one;
    std::copy_n(numbers.begin() + static_cast<std::ptrdiff_t>(i), one.size(), one.begin());
    poses.push_back(control::pose_of(one));
  }
  return poses;
}

base::Result<Pose> read_pose_of(const std::vector<double>& numbers) {
  auto poses = read_poses_of(numbers);
  if (!poses) return base::Error{poses.error()};
  if (poses.value().size() == 1) return poses.value().front();
  return base::Error{"found " + std::to_string(poses.value().size()) + " poses, expected one"};
}

base::Result<JogFrame> read_frame_of(std::string_view name) {
  if (name == "base") return JogFrame::kBase;
  if (name == "tool") return JogFrame::kTool;
  return base::Error{"jog_frame is " + base::quoted(name) + ", expected base or tool"};
}

std::string objection_to(const ToolAxis& axis, double most) {
  if (axis.number < 1 || axis.number > 6) {
    return "axis " + std::to_string(axis.number) +
           ": expected 1 to 6: along x, y, z, then about x, y, z";
  }
  const std::string of_axis = "axis " + std::to_string(axis.number) + ": ";
  if (!std::isfinite(axis.velocity)) return of_axis + "the velocity is not finite";
  if (axis.velocity == 0.0) return of_axis + "the velocity is 0";
  if (std::abs(axis.velocity) <= most) return {};
  char text[96];
  std::snprintf(text, sizeof text, "the tool would be too fast: %g, expected %g %s at most",
                axis.velocity, most, axis.turns() ? "rad/s" : "m/s");
  return of_axis + text;
}

double way_of(const ToolAxis& axis) {
  return std::abs(axis.velocity) * (axis.turns() ? kWayOfATurn : 1.0);
}

base::Result<control::PosePath> line_along(const Pose& from, const ToolAxis& axis) {
  Pose to = from;
  const auto index = static_cast<std::size_t>((axis.number - 1) % 3);
  const double direction = axis.velocity > 0.0 ? 1.0 : -1.0;
  const bool of_tool = axis.frame == JogFrame::kTool;
  if (axis.turns()) {
    const auto turn = turned(axis.number - 1, direction * kFurthestTurn);
    to.rotation = of_tool ? product(from.rotation, turn) : product(turn, from.rotation);
  } else {
    for (std::size_t i = 0; i < 3; ++i) {
      const double along = of_tool ? from.rotation[3 * i + index] : (i == index ? 1.0 : 0.0);
      to.position[i] += direction * kLongestJog * along;
    }
  }
  return control::PosePath::line(from, to);
}

std::string_view longest_text(const ToolAxis& axis) {
  return axis.turns() ? "2.5 rad are the most at once: jog again"
                      : "1 m is the most at once: jog again";
}

}  // namespace armature::controllers
