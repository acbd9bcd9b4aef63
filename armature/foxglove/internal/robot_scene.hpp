// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"
#include "armature/control/dynamics/robot_frames.hpp"
#include "armature/foxglove/internal/joint_source.hpp"
#include "armature/foxglove/internal/json.hpp"

namespace armature::foxglove::internal {

/// Which robot a component describes.
struct NamedRobot {
  std::string owner;  ///< the component
  std::string path;   ///< of the description (URDF), as the component has it
  std::string base;   ///< link that stands still; empty: the root
  std::string tip;    ///< end of the chain of joints; empty: all joints
};

/// By the components' properties `robot_description`, `base_link` and `tip_link`; a description is
/// there once.
std::vector<NamedRobot> robots_of(const std::vector<inspect::ComponentDescription>& components);

/// A robot as Foxglove draws it: frames that move with its joints, and shapes in them.
class RobotScene {
 public:
  /// @param prefix  of the names of frames; of one robot alone empty
  static base::Result<RobotScene> make(const std::string& description, const NamedRobot& robot,
                                       std::string prefix);

  /// Of its joints that move.
  std::size_t joints() const { return moving_.size(); }
  /// Objects of foxglove.FrameTransform.
  /// @param positions  of the joints that move, from the base on; those that are missing, or NaN,
  ///                   count as 0
  void add_transforms(base::Time time, std::span<const double> positions, Json& to) const;
  /// Objects of foxglove.SceneEntity, one for each link.
  void add_entities(base::Time time, Json& to) const;

 private:
  RobotScene(control::RobotFrames frames, std::vector<std::size_t> moving, std::string prefix)
      : frames_(std::move(frames)), moving_(std::move(moving)), prefix_(std::move(prefix)) {}

  control::RobotFrames frames_;
  std::vector<std::size_t> moving_;
  std::string prefix_;
};

}  // namespace armature::foxglove::internal
