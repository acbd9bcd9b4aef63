// SPDX-License-Identifier: Apache-2.0
#include "armature/control/dynamics/robot_frames.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <string_view>

#include <pugixml.hpp>

#include "armature/base/quoted.hpp"

namespace armature::control {
namespace {

using FrameVector = std::array<double, 3>;
using FrameTurn = std::array<double, 4>;
using Colours = std::map<std::string, std::array<double, 4>>;

constexpr std::array<double, 4> kPlain{0.62, 0.66, 0.72, 1.0};
constexpr double kBoneRadius = 0.02;  ///< [m]

FrameTurn turn_after(const FrameTurn& a, const FrameTurn& b) {
  return {a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
          a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
          a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
          a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]};
}

FrameVector turned_by(const FrameTurn& by, const FrameVector& vector) {
  const FrameTurn back{-by[0], -by[1], -by[2], by[3]};
  const FrameTurn result = turn_after(turn_after(by, {vector[0], vector[1], vector[2], 0.0}), back);
  return {result[0], result[1], result[2]};
}

double frame_length(const FrameVector& vector) {
  return std::hypot(vector[0], vector[1], vector[2]);
}

FrameTurn turn_about(const FrameVector& axis, double angle) {
  const double part = std::sin(angle / 2.0);
  return {axis[0] * part, axis[1] * part, axis[2] * part, std::cos(angle / 2.0)};
}

/// URDF turns about the fixed axes x, y and z, in this order.
FrameTurn from_roll_pitch_yaw(const FrameVector& angles) {
  return turn_after(turn_after(turn_about({0, 0, 1}, angles[2]), turn_about({0, 1, 0}, angles[1])),
                    turn_about({1, 0, 0}, angles[0]));
}

/// The turn that brings z into a direction.
FrameTurn turn_along(const FrameVector& direction) {
  const double length = frame_length(direction);
  const FrameVector unit{direction[0] / length, direction[1] / length, direction[2] / length};
  if (unit[2] < -1.0 + 1e-9) return {1.0, 0.0, 0.0, 0.0};
  const double w = std::sqrt((1.0 + unit[2]) / 2.0);
  return {-unit[1] / (2.0 * w), unit[0] / (2.0 * w), 0.0, w};
}

/// Numbers with blanks between them; those that are missing stay as they were.
template <std::size_t N>
std::array<double, N> numbers_in(pugi::xml_attribute attribute, std::array<double, N> otherwise) {
  std::istringstream text(attribute.value());
  text.imbue(std::locale::classic());
  for (double& number : otherwise) {
    double read = 0.0;
    if (text >> read && std::isfinite(read)) number = read;
  }
  return otherwise;
}

FramePose pose_of(pugi::xml_node origin) {
  return {numbers_in<3>(origin.attribute("xyz"), {}),
          from_roll_pitch_yaw(numbers_in<3>(origin.attribute("rpy"), {}))};
}

std::array<double, 4> colour_of(pugi::xml_node visual, const Colours& known) {
  const pugi::xml_node material = visual.child("material");
  if (const pugi::xml_node own = material.child("color")) {
    return numbers_in<4>(own.attribute("rgba"), kPlain);
  }
  const auto found = known.find(material.attribute("name").value());
  return found == known.end() ? kPlain : found->second;
}

std::optional<LinkShape> shape_of(pugi::xml_node visual, const std::string& link,
                                  const Colours& colours) {
  LinkShape shape{link, {}, pose_of(visual.child("origin")), {}, colour_of(visual, colours)};
  const pugi::xml_node geometry = visual.child("geometry");
  const pugi::xml_node box = geometry.child("box");
  const pugi::xml_node cylinder = geometry.child("cylinder");
  const pugi::xml_node sphere = geometry.child("sphere");
  if (box) {
    shape.size = numbers_in<3>(box.attribute("size"), {});
  } else if (cylinder) {
    const double width = 2.0 * cylinder.attribute("radius").as_double();
    shape.kind = LinkShape::Kind::kCylinder;
    shape.size = {width, width, cylinder.attribute("length").as_double()};
  } else if (sphere) {
    const double width = 2.0 * sphere.attribute("radius").as_double();
    shape.kind = LinkShape::Kind::kSphere;
    shape.size = {width, width, width};
  } else {
    return std::nullopt;
  }
  return shape;
}

RobotFrames::Joint joint_of(pugi::xml_node node) {
  const std::string_view type = node.attribute("type").value();
  RobotFrames::Joint joint;
  joint.name = node.attribute("name").value();
  joint.parent = node.child("parent").attribute("link").value();
  joint.child = node.child("child").attribute("link").value();
  joint.slides = type == "prismatic";
  // One that follows another has no position of its own, and is drawn at 0.
  joint.moves =
      (joint.slides || type == "revolute" || type == "continuous") && !node.child("mimic");
  joint.origin = pose_of(node.child("origin"));
  joint.axis = numbers_in<3>(node.child("axis").attribute("xyz"), {1.0, 0.0, 0.0});
  const double length = frame_length(joint.axis);
  for (double& part : joint.axis) part = length > 0.0 ? part / length : 0.0;
  return joint;
}

}  // namespace

FramePose combined(const FramePose& outer, const FramePose& inner) {
  FrameVector position = turned_by(outer.rotation, inner.position);
  for (std::size_t i = 0; i < 3; ++i) position[i] += outer.position[i];
  return {position, turn_after(outer.rotation, inner.rotation)};
}

base::Result<RobotFrames> RobotFrames::parse(const std::string& text) {
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_buffer(text.data(), text.size());
  const std::string expected = "expected the description of a robot (URDF), found ";
  if (!parsed) {
    return base::Error{expected + "no XML: " + parsed.description() + " at byte " +
                       std::to_string(parsed.offset)};
  }
  const pugi::xml_node robot = document.child("robot");
  if (!robot) return base::Error{expected + "<" + document.document_element().name() + ">"};
  RobotFrames frames;
  frames.name_ = robot.attribute("name").value();
  Colours colours;
  for (const pugi::xml_node material : robot.children("material")) {
    colours[material.attribute("name").value()] =
        numbers_in<4>(material.child("color").attribute("rgba"), kPlain);
  }
  for (const pugi::xml_node link : robot.children("link")) {
    frames.links_.emplace_back(link.attribute("name").value());
    for (const pugi::xml_node visual : link.children("visual")) {
      if (auto shape = shape_of(visual, frames.links_.back(), colours)) {
        frames.shapes_.push_back(*std::move(shape));
      }
    }
  }
  std::set<std::string> hung;
  for (const pugi::xml_node node : robot.children("joint")) {
    Joint joint = joint_of(node);
    for (const std::string& link : {joint.parent, joint.child}) {
      if (std::ranges::count(frames.links_, link) > 0) continue;
      return base::Error{"joint " + base::quoted(joint.name) + " is at the link " +
                         base::quoted(link) + ", which the description does not have"};
    }
    if (!hung.insert(joint.child).second) {
      return base::Error{"the link " + base::quoted(joint.child) + " hangs at two joints"};
    }
    frames.joints_.push_back(std::move(joint));
  }
  frames.add_bones();
  return frames;
}

void RobotFrames::add_bones() {
  const auto has_shape = [this](const std::string& link) {
    return std::ranges::any_of(shapes_, [&](const LinkShape& one) { return one.link == link; });
  };
  std::set<std::string> bare;
  for (const std::string& link : links_) {
    if (!has_shape(link)) bare.insert(link);
  }
  for (const Joint& joint : joints_) {
    const FrameVector& end = joint.origin.position;
    const double length = frame_length(end);
    if (!bare.contains(joint.parent) || length == 0.0) continue;
    const FramePose middle{{end[0] / 2.0, end[1] / 2.0, end[2] / 2.0}, turn_along(end)};
    shapes_.push_back({joint.parent,
                       LinkShape::Kind::kCylinder,
                       middle,
                       {2.0 * kBoneRadius, 2.0 * kBoneRadius, length},
                       kPlain});
  }
}

std::vector<std::size_t> RobotFrames::moving(const std::string& base,
                                             const std::string& tip) const {
  std::vector<std::size_t> chain;
  if (tip.empty()) {
    for (const std::string& link : links_) {
      const bool hangs = std::ranges::count(joints_, link, &Joint::child) > 0;
      if (base.empty() ? !hangs : link == base) add_behind(link, chain);
    }
  } else {
    std::string link = tip;
    while (link != base && chain.size() < joints_.size()) {
      const auto last = std::ranges::find(joints_, link, &Joint::child);
      if (last == joints_.end()) break;
      chain.insert(chain.begin(), static_cast<std::size_t>(last - joints_.begin()));
      link = last->parent;
    }
  }
  std::erase_if(chain, [this](std::size_t one) { return !joints_[one].moves; });
  return chain;
}

/// No link hangs at two joints, so only a ring could lead back: it has no link to begin from but a
/// base that is named.
void RobotFrames::add_behind(const std::string& link, std::vector<std::size_t>& found) const {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    if (joints_[i].parent != link || std::ranges::count(found, i) > 0) continue;
    found.push_back(i);
    add_behind(joints_[i].child, found);
  }
}

FramePose RobotFrames::pose(std::size_t joint, double position) const {
  const Joint& one = joints_[joint];
  if (!one.moves) return one.origin;
  if (!one.slides) return combined(one.origin, {{}, turn_about(one.axis, position)});
  const FrameVector way{one.axis[0] * position, one.axis[1] * position, one.axis[2] * position};
  return combined(one.origin, {way, {0.0, 0.0, 0.0, 1.0}});
}

}  // namespace armature::control
