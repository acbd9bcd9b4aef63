// SPDX-License-Identifier: Apache-2.0
#include "armature/sim/internal/ray_scene.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace armature::sim::internal {
namespace {

/// Geometries of this group and above are hidden, as in MuJoCo's own viewer.
constexpr int kHiddenGroup = 3;

double in_steps(double value, double steps) { return std::floor(value * steps + 0.5) / steps; }

/// Of a quaternion of any length but 0.
Matrix rotation_of(double w, double x, double y, double z) {
  const double s = 2.0 / (w * w + x * x + y * y + z * z);
  return {Vector{1.0 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)},
          Vector{s * (x * y + z * w), 1.0 - s * (x * x + z * z), s * (y * z - x * w)},
          Vector{s * (x * z - y * w), s * (y * z + x * w), 1.0 - s * (x * x + y * y)}};
}

Pose pose_at(const mjtNum* position, const mjtNum* quaternion, int index) {
  Pose pose;
  std::copy_n(position + 3 * index, 3, pose.position.begin());
  std::copy_n(quaternion + 4 * index, 4, pose.orientation.begin());
  return pose;
}

double check_of(const mjModel& model, int geom) {
  return model.nuser_geom > 0 ? model.geom_user[geom * model.nuser_geom] : 0.0;
}

std::optional<Shape> shape_of(const mjModel& model, int geom) {
  const mjtNum* const size = model.geom_size + 3 * geom;
  switch (model.geom_type[geom]) {
    case mjGEOM_PLANE:
      return PlaneShape{size[0], size[1], check_of(model, geom)};
    case mjGEOM_SPHERE:
      return SphereShape{size[0]};
    case mjGEOM_BOX:
      return BoxShape{{size[0], size[1], size[2]}};
    case mjGEOM_CYLINDER:
      return CylinderShape{size[0], size[1]};
    default:
      return std::nullopt;
  }
}

double reach_of(const mjModel& model, int geom) {
  return model.geom_type[geom] == mjGEOM_PLANE ? -1.0 : model.geom_rbound[geom];
}

std::array<int, 3> colour_of(const mjModel& model, int geom) {
  const int material = model.geom_matid[geom];
  const float* const rgba =
      material >= 0 ? model.mat_rgba + 4 * material : model.geom_rgba + 4 * geom;
  std::array<int, 3> colour{};
  for (std::size_t i = 0; i < colour.size(); ++i) {
    colour[i] = std::clamp(static_cast<int>(std::floor(rgba[i] * 255.0F + 0.5F)), 0, 255);
  }
  return colour;
}

/// The robot that carries the camera does not see itself.
bool is_of_carrier(const mjModel& model, int geom, int camera_body) {
  const int root = model.body_rootid[camera_body];
  return root != 0 && model.body_rootid[model.geom_bodyid[geom]] == root;
}

void put_bodies(const mjModel& model, Scene& scene) {
  const Data data(mj_makeData(&model));
  mj_kinematics(&model, data.get());
  for (int body = 0; body < model.nbody; ++body) {
    scene.bodies.push_back(snapped(pose_at(data->xpos, data->xquat, body)));
  }
}

}  // namespace

Frame snapped(const Pose& pose) {
  constexpr double kLengths = 16777216.0;      // 2^24
  constexpr double kRotations = 1073741824.0;  // 2^30
  const auto& p = pose.position;
  const auto& q = pose.orientation;
  return {{in_steps(p[0], kLengths), in_steps(p[1], kLengths), in_steps(p[2], kLengths)},
          rotation_of(in_steps(q[0], kRotations), in_steps(q[1], kRotations),
                      in_steps(q[2], kRotations), in_steps(q[3], kRotations))};
}

base::Result<Scene> make_scene(mjModel& model, const std::string& name, const std::string& camera) {
  const int eye = mj_name2id(&model, mjOBJ_CAMERA, camera.c_str());
  if (eye < 0) return base::Error{name + ": unknown camera '" + camera + "'"};
  Scene scene;
  put_bodies(model, scene);
  scene.eye_body = static_cast<std::size_t>(model.cam_bodyid[eye]);
  scene.eye_on_body = snapped(pose_at(model.cam_pos, model.cam_quat, eye));
  scene.field_of_view = model.cam_fovy[eye] * mjPI / 180.0;
  for (int geom = 0; geom < model.ngeom; ++geom) {
    if (model.geom_group[geom] >= kHiddenGroup) continue;
    if (is_of_carrier(model, geom, model.cam_bodyid[eye])) continue;
    const std::optional<Shape> shape = shape_of(model, geom);
    if (!shape) {
      return base::Error{name + ": the geometry '" + std::string(name_of(model, mjOBJ_GEOM, geom)) +
                         "' is expected to be a plane, sphere, box or cylinder (hide another in "
                         "group 3)"};
    }
    scene.things.push_back({.shape = *shape,
                            .body = static_cast<std::size_t>(model.geom_bodyid[geom]),
                            .on_body = snapped(pose_at(model.geom_pos, model.geom_quat, geom)),
                            .colour = colour_of(model, geom),
                            .reach = reach_of(model, geom)});
  }
  return scene;
}

}  // namespace armature::sim::internal
