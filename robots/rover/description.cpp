// SPDX-License-Identifier: Apache-2.0
#include "robots/rover/description.hpp"

#include <initializer_list>
#include <string_view>
#include <utility>

#include "robots/rover/numbers.hpp"

namespace armature::rover {
namespace {

/// Only wheels and caster touch the floor with friction of their own: the floor has none, and of
/// two frictions the larger counts.
constexpr std::string_view kArena = R"(
    <geom name="floor" type="plane" size="3 2 1" rgba="0.55 0.55 0.52 1" user="0.5" friction="0 0 0"/>
    <geom name="east" type="plane" size="0.25 2 1" pos="3 0 0.25" zaxis="-1 0 0" rgba="0.78 0.78 0.74 1"/>
    <geom name="west" type="plane" size="0.25 2 1" pos="-3 0 0.25" zaxis="1 0 0" rgba="0.78 0.78 0.74 1"/>
    <geom name="north" type="plane" size="3 0.25 1" pos="0 2 0.25" zaxis="0 -1 0" rgba="0.70 0.74 0.78 1"/>
    <geom name="south" type="plane" size="3 0.25 1" pos="0 -2 0.25" zaxis="0 1 0" rgba="0.70 0.74 0.78 1"/>
    <geom name="post" type="cylinder" size="0.05 0.30" pos="2.4 1.4 0.30" rgba="0.95 0.50 0.05 1"/>
    <geom name="box" type="box" size="0.15 0.15 0.15" pos="2.2 -1.4 0.15" rgba="0.10 0.20 0.80 1"/>
    <geom name="screen" type="box" size="0.01 0.16 0.25" pos="2.1 0 0.25" rgba="0.85 0.85 0.85 1"/>
    <body name="ball" pos="{ball_x} 0 {ball_radius}">
      <geom type="sphere" size="{ball_radius}" rgba="0.85 0.08 0.10 1" contype="0" conaffinity="0"/>
    </body>
)";

constexpr std::string_view kBody = R"(
    <body name="rover" pos="{begin_x} 0 {wheel_radius}">
      <freejoint/>
      <geom name="chassis" type="box" size="0.13 0.11 0.04" pos="-0.03 0 0.03" mass="{chassis_mass}" rgba="0.2 0.2 0.2 1"/>
      <geom name="mast" type="cylinder" size="0.01 0.10" pos="{camera_ahead} 0 0.16" mass="0.1" rgba="0.2 0.2 0.2 1"/>
      <camera name="eye" pos="{camera_ahead} 0 {camera_above}" fovy="50" xyaxes="0 -1 0 0.24192189559966773 0 0.97029572627599647"/>
)";

constexpr std::string_view kCaster = R"(
      <geom name="caster" type="sphere" size="0.02" pos="-0.13 0 -0.03" mass="0.1" friction="0.02 0 0" rgba="0.4 0.4 0.4 1"/>
)";

/// A wheel touches the floor in one point, so that it turns about its contact without scrubbing.
constexpr std::string_view kWheel = R"(
      <body name="wheel{number}" pos="{x} {y} 0">
        <joint name="axle{number}" axis="0 1 0" armature="{armature}" damping="0.002" frictionloss="0.02"/>
        <geom type="cylinder" size="{wheel_radius} 0.012" zaxis="0 1 0" mass="0.2" contype="0" conaffinity="0" rgba="0.1 0.1 0.1 1"/>
        <geom type="sphere" size="{wheel_radius}" mass="0" group="3" friction="0.8 0.005 0.0001"/>
      </body>
)";

constexpr double kAxleToAxle = 0.16;  ///< of four wheels [m]
constexpr double kMass = 3.0;         ///< of all [kg]
constexpr double kMastMass = 0.1;     ///< [kg]

using Numbers = std::initializer_list<std::pair<std::string_view, double>>;

/// The text with its `{names}` replaced.
std::string filled(std::string_view text, Numbers numbers) {
  std::string result(text);
  for (const auto& [name, number] : numbers) {
    const std::string place = "{" + std::string(name) + "}";
    for (std::size_t at = result.find(place); at != std::string::npos; at = result.find(place)) {
      result.replace(at, place.size(), std::to_string(number));
    }
  }
  return result;
}

std::string wheel(int number) {
  const bool left = number % 2 == 1;
  const bool front = number <= 2;
  const double turns = kMotor.gear_ratio;
  std::string text = filled(kWheel, {{"x", front ? 0.0 : -kAxleToAxle},
                                     {"y", left ? 0.5 * kTrack : -0.5 * kTrack},
                                     {"wheel_radius", kWheelRadius},
                                     {"armature", kMotor.rotor_inertia * turns * turns}});
  constexpr std::string_view kNumber = "{number}";
  for (std::size_t at = text.find(kNumber); at != std::string::npos; at = text.find(kNumber)) {
    text.replace(at, kNumber.size(), std::to_string(number));
  }
  return text;
}

}  // namespace

std::string description(int wheels) {
  const double wheels_mass = wheels == 2 ? 2 * 0.2 + 0.1 : 4 * 0.2;
  std::string text = "<mujoco model=\"rover\">\n  <size nuser_geom=\"1\"/>\n  <worldbody>";
  text += filled(kArena, {{"ball_x", kBallRestX}, {"ball_radius", kBallRadius}});
  text += filled(kBody, {{"begin_x", kBeginX},
                         {"wheel_radius", kWheelRadius},
                         {"chassis_mass", kMass - kMastMass - wheels_mass},
                         {"camera_ahead", kCameraAhead},
                         {"camera_above", kCameraHeight - kWheelRadius}});
  if (wheels == 2) text += kCaster;
  for (int number = 1; number <= wheels; ++number) text += wheel(number);
  return text + "    </body>\n  </worldbody>\n</mujoco>\n";
}

}  // namespace armature::rover
