// SPDX-License-Identifier: Apache-2.0
#include "armature/cli/robot/serial_arm.hpp"

#include <string_view>
#include <vector>

#include "armature/cli/new_folder.hpp"
#include "armature/cli/robot/figures.hpp"

namespace armature::cli {
namespace {

constexpr double kReach = 1.0;        // m
constexpr double kHeaviest = 4.0;     // kg, the first link
constexpr double kLighter = 0.75;     // each link than the one before
constexpr double kRadius = 0.06;      // m, of a link
constexpr double kGravity = 9.81;     // m/s^2
constexpr double kEnough = 2.5;       // times the weight
constexpr double kLeastTorque = 5.0;  // Nm

/// A solid cylinder from its joint upwards.
constexpr std::string_view kLink = R"(  <link name="link@number@">
    <visual>
      <origin xyz="0 0 @middle@"/>
      <geometry><cylinder radius="@radius@" length="@length@"/></geometry>
    </visual>
    <inertial>
      <origin xyz="0 0 @middle@"/>
      <mass value="@mass@"/>
      <inertia ixx="@across@" iyy="@across@" izz="@along@" ixy="0" ixz="0" iyz="0"/>
    </inertial>
  </link>
)";

constexpr std::string_view kJoint = R"(  <joint name="joint@number@" type="revolute">
    <parent link="@parent@"/>
    <child link="link@number@"/>
    <origin xyz="0 0 @height@"/>
    <axis xyz="@axis@"/>
    <limit lower="-1.9" upper="1.9" effort="@effort@" velocity="2"/>
    <dynamics damping="0.1"/>
  </joint>
)";

struct Links {
  double length = 0.0;
  std::vector<double> masses;
};

/// What holds the arm where it is stretched out level from this joint on.
double weight_from(const Links& links, std::size_t joint) {
  double weight = 0.0;
  double way = links.length / 2.0;
  for (std::size_t i = joint; i < links.masses.size(); ++i, way += links.length) {
    weight += links.masses[i] * kGravity * way;
  }
  return weight;
}

/// Shoulder, elbow and wrist: z y y z y z; a single joint carries its link.
bool along_the_link(std::size_t joint, std::size_t joints) {
  if (joint == 0) return joints > 1;
  return joint > 2 && joint % 2 == 1;
}

Words words_of(const Links& links, std::size_t joint) {
  const double mass = links.masses[joint];
  const double along = mass * kRadius * kRadius / 2.0;
  const double across = along / 2.0 + mass * links.length * links.length / 12.0;
  const double torque = kEnough * weight_from(links, joint) + kLeastTorque;
  return {{"number", std::to_string(joint + 1)},
          {"parent", joint == 0 ? "base" : "link" + std::to_string(joint)},
          {"height", joint == 0 ? "0" : figures_of(links.length)},
          {"axis", along_the_link(joint, links.masses.size()) ? "0 0 1" : "0 1 0"},
          {"effort", figures_of(rounded(torque))},
          {"middle", figures_of(links.length / 2.0)},
          {"length", figures_of(links.length)},
          {"radius", figures_of(kRadius)},
          {"mass", figures_of(mass)},
          {"along", figures_of(along)},
          {"across", figures_of(across)}};
}

}  // namespace

std::string serial_arm(const std::string& name, std::size_t joints) {
  Links links{.length = rounded(kReach / static_cast<double>(joints)), .masses = {}};
  double mass = kHeaviest;
  for (std::size_t i = 0; i < joints; ++i, mass = rounded(mass * kLighter)) {
    links.masses.push_back(mass);
  }
  std::string text =
      "<?xml version=\"1.0\"?>\n<!-- An arm to begin with: put your own in its place. "
      "m, kg, kg m^2, rad, Nm. -->\n<robot name=\"" +
      name + "\">\n  <link name=\"base\"/>\n";
  for (std::size_t i = 0; i < joints; ++i) text += filled(kLink, words_of(links, i));
  for (std::size_t i = 0; i < joints; ++i) text += filled(kJoint, words_of(links, i));
  return text + "</robot>\n";
}

}  // namespace armature::cli
