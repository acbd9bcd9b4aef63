// SPDX-License-Identifier: Apache-2.0
#include "armature/foxglove/internal/scene_schemas.hpp"

#include <initializer_list>
#include <utility>

#include "armature/foxglove/internal/json.hpp"

namespace armature::foxglove::internal {
namespace {

using Members = std::initializer_list<std::pair<const char*, Json>>;

Json object_schema(const char* title, Members members) {
  Json json{{"type", "object"}, {"title", title}, {"properties", Json::object()}};
  for (const auto& [name, member] : members) json["properties"][name] = member;
  return json;
}

Json array_of(const Json& element) { return {{"type", "array"}, {"items", element}}; }

Json numbers_schema(const char* title, std::initializer_list<const char*> names) {
  Json json = object_schema(title, {});
  for (const char* const name : names) json["properties"][name] = {{"type", "number"}};
  return json;
}

const Json kText{{"type", "string"}};

Json time_schema() {
  return object_schema("time",
                       {{"sec", {{"type", "integer"}, {"minimum", 0}}},
                        {"nsec", {{"type", "integer"}, {"minimum", 0}, {"maximum", 999999999}}}});
}

Json duration_schema() {
  return object_schema("duration",
                       {{"sec", {{"type", "integer"}}},
                        {"nsec", {{"type", "integer"}, {"minimum", 0}, {"maximum", 999999999}}}});
}

Json vector_schema() { return numbers_schema("foxglove.Vector3", {"x", "y", "z"}); }
Json quaternion_schema() { return numbers_schema("foxglove.Quaternion", {"x", "y", "z", "w"}); }
Json colour_schema() { return numbers_schema("foxglove.Color", {"r", "g", "b", "a"}); }

Json pose_schema() {
  return object_schema("foxglove.Pose",
                       {{"position", vector_schema()}, {"orientation", quaternion_schema()}});
}

Json shape_schema(const char* title) {
  return object_schema(
      title, {{"pose", pose_schema()}, {"size", vector_schema()}, {"color", colour_schema()}});
}

}  // namespace

std::string transforms_schema() {
  const Json transform =
      object_schema("foxglove.FrameTransform", {{"timestamp", time_schema()},
                                                {"parent_frame_id", kText},
                                                {"child_frame_id", kText},
                                                {"translation", vector_schema()},
                                                {"rotation", quaternion_schema()}});
  return text_of(object_schema(kTransformsName, {{"transforms", array_of(transform)}}));
}

std::string scene_schema() {
  Json cylinder = shape_schema("foxglove.CylinderPrimitive");
  for (const char* const name : {"bottom_scale", "top_scale"}) {
    cylinder["properties"][name] = {{"type", "number"}};
  }
  const Json empty = array_of(object_schema("none", {}));
  const Json entity = object_schema(
      "foxglove.SceneEntity", {{"timestamp", time_schema()},
                               {"frame_id", kText},
                               {"id", kText},
                               {"lifetime", duration_schema()},
                               {"frame_locked", {{"type", "boolean"}}},
                               {"metadata", empty},
                               {"arrows", empty},
                               {"cubes", array_of(shape_schema("foxglove.CubePrimitive"))},
                               {"spheres", array_of(shape_schema("foxglove.SpherePrimitive"))},
                               {"cylinders", array_of(cylinder)},
                               {"lines", empty},
                               {"triangles", empty},
                               {"texts", empty},
                               {"models", empty}});
  return text_of(object_schema(kSceneName, {{"deletions", empty}, {"entities", array_of(entity)}}));
}

}  // namespace armature::foxglove::internal
