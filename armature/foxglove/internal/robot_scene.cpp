// SPDX-License-Identifier: Apache-2.0
#include "armature/foxglove/internal/robot_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <utility>

namespace armature::foxglove::internal {
namespace {

using control::LinkShape;

constexpr const char* kDescription = "robot_description";  ///< as controllers call it

Json stamp(base::Time time) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  const std::int64_t ns = std::max<std::int64_t>(base::to_ns(time), 0);
  return {{"sec", ns / kSecond}, {"nsec", ns % kSecond}};
}

Json vector(const std::array<double, 3>& of) { return {{"x", of[0]}, {"y", of[1]}, {"z", of[2]}}; }

Json quaternion(const std::array<double, 4>& of) {
  return {{"x", of[0]}, {"y", of[1]}, {"z", of[2]}, {"w", of[3]}};
}

Json primitive_of(const LinkShape& shape) {
  const auto& colour = shape.colour;
  Json json{{"pose",
             {{"position", vector(shape.pose.position)},
              {"orientation", quaternion(shape.pose.rotation)}}},
            {"size", vector(shape.size)},
            {"color", {{"r", colour[0]}, {"g", colour[1]}, {"b", colour[2]}, {"a", colour[3]}}}};
  if (shape.kind == LinkShape::Kind::kCylinder) json["bottom_scale"] = json["top_scale"] = 1.0;
  return json;
}

const char* list_for(LinkShape::Kind kind) {
  if (kind == LinkShape::Kind::kBox) return "cubes";
  return kind == LinkShape::Kind::kCylinder ? "cylinders" : "spheres";
}

Json empty_entity(base::Time time, const std::string& frame) {
  Json entity{{"timestamp", stamp(time)},
              {"frame_id", frame},
              {"id", frame},
              {"lifetime", {{"sec", 0}, {"nsec", 0}}},
              {"frame_locked", true}};
  for (const char* const list : {"metadata", "arrows", "cubes", "spheres", "cylinders", "lines",
                                 "triangles", "texts", "models"}) {
    entity[list] = Json::array();
  }
  return entity;
}

std::string value_of(const inspect::ComponentDescription& component, const char* property) {
  const auto found =
      std::ranges::find(component.properties, property, &inspect::PropertyDescription::name);
  return found == component.properties.end() ? std::string() : found->value;
}

}  // namespace

std::vector<NamedRobot> robots_of(const std::vector<inspect::ComponentDescription>& components) {
  std::vector<NamedRobot> robots;
  for (const auto& one : components) {
    const std::string path = value_of(one, kDescription);
    const auto normal = std::filesystem::path(path).lexically_normal();
    const bool known = std::ranges::any_of(robots, [&](const NamedRobot& robot) {
      return std::filesystem::path(robot.path).lexically_normal() == normal;
    });
    if (path.empty() || known) continue;
    robots.push_back({one.name, path, value_of(one, "base_link"), value_of(one, "tip_link")});
  }
  return robots;
}

base::Result<RobotScene> RobotScene::make(const std::string& description, const NamedRobot& robot,
                                          std::string prefix) {
  auto frames = control::RobotFrames::parse(description);
  if (!frames) return base::Error{"'" + robot.path + "': " + frames.error()};
  auto moving = frames.value().moving(robot.base, robot.tip);
  return RobotScene(std::move(frames).value(), std::move(moving), std::move(prefix));
}

void RobotScene::add_transforms(base::Time time, std::span<const double> positions,
                                Json& to) const {
  std::map<std::size_t, double> at;
  for (std::size_t i = 0; i < std::min(moving_.size(), positions.size()); ++i) {
    if (std::isfinite(positions[i])) at[moving_[i]] = positions[i];
  }
  for (std::size_t i = 0; i < frames_.joints().size(); ++i) {
    const auto& joint = frames_.joints()[i];
    const auto found = at.find(i);
    const control::FramePose pose = frames_.pose(i, found == at.end() ? 0.0 : found->second);
    to.push_back({{"timestamp", stamp(time)},
                  {"parent_frame_id", prefix_ + joint.parent},
                  {"child_frame_id", prefix_ + joint.child},
                  {"translation", vector(pose.position)},
                  {"rotation", quaternion(pose.rotation)}});
  }
}

void RobotScene::add_entities(base::Time time, Json& to) const {
  std::map<std::string, Json> entities;
  for (const LinkShape& shape : frames_.shapes()) {
    const std::string frame = prefix_ + shape.link;
    auto [entity, is_new] = entities.try_emplace(frame);
    if (is_new) entity->second = empty_entity(time, frame);
    entity->second[list_for(shape.kind)].push_back(primitive_of(shape));
  }
  for (auto& [frame, entity] : entities) to.push_back(std::move(entity));
}

}  // namespace armature::foxglove::internal
