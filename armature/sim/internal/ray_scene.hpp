// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/sim/internal/mujoco_model.hpp"
#include "armature/sim/internal/ray_shapes.hpp"
#include "armature/sim/pose.hpp"

namespace armature::sim::internal {

/// A place and a rotation: of a body, or of something on it.
struct Frame {
  Vector position;
  Matrix rotation{Vector{1.0, 0.0, 0.0}, Vector{0.0, 1.0, 0.0}, Vector{0.0, 0.0, 1.0}};
};
inline Frame operator*(const Frame& outer, const Frame& inner) {
  return {outer.position + outer.rotation * inner.position, outer.rotation * inner.rotation};
}

/// In steps that last bits do not matter to: see RayCamera.
Frame snapped(const Pose& pose);

using Shape = std::variant<PlaneShape, SphereShape, BoxShape, CylinderShape>;

/// Something to be seen, on a body.
struct Thing {
  Shape shape;
  std::size_t body = 0;
  Frame on_body;
  std::array<int, 3> colour{};  ///< red, green, blue, 0 to 255
  double reach = -1.0;          ///< radius of a ball around it; < 0: it has no end
};

/// What a camera of a description may see, and from where.
struct Scene {
  std::vector<Thing> things;
  std::vector<Frame> bodies;  ///< where the description has them
  std::size_t eye_body = 0;
  Frame eye_on_body;
  double field_of_view = 0.0;  ///< vertical [rad]
};

/// An error names the camera, or the geometry that is of no shape that is known.
base::Result<Scene> make_scene(mjModel& model, const std::string& name, const std::string& camera);

}  // namespace armature::sim::internal
