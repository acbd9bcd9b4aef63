// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "armature/base/result.hpp"

namespace armature::control {

/// Where a frame is in the axes of another, and how it is turned.
struct FramePose {
  std::array<double, 3> position{};                    ///< [m]
  std::array<double, 4> rotation{0.0, 0.0, 0.0, 1.0};  ///< unit quaternion x, y, z, w

  bool operator==(const FramePose&) const = default;
};

/// `inner` is in the axes of `outer`: the same in the axes that `outer` is in.
FramePose combined(const FramePose& outer, const FramePose& inner);

/// What a link looks like, or a part of it.
struct LinkShape {
  /// A cylinder lies along z.
  enum class Kind { kBox, kCylinder, kSphere };

  std::string link;
  Kind kind = Kind::kBox;
  FramePose pose{};                ///< of its middle, in the link's axes
  std::array<double, 3> size{};    ///< [m] in x, y and z
  std::array<double, 4> colour{};  ///< red, green, blue, opacity: 0 to 1
};

/// The links of a robot as its description (URDF) has them: how they hang together, where they are,
/// and simple shapes to draw. A link without a box, cylinder or sphere, such as one with a mesh,
/// gets bones to the joints behind it.
class RobotFrames {
 public:
  /// How a link hangs at another.
  struct Joint {
    std::string name;
    std::string parent;  ///< link
    std::string child;   ///< link
    bool moves = false;
    bool slides = false;           ///< positions are m, and not rad
    FramePose origin{};            ///< of the child at 0, in the parent's axes
    std::array<double, 3> axis{};  ///< of length 1, in the child's axes
  };

  /// The error says what was expected and what was found.
  static base::Result<RobotFrames> parse(const std::string& text);

  const std::string& name() const { return name_; }
  /// In the order of the description.
  const std::vector<Joint>& joints() const { return joints_; }
  const std::vector<LinkShape>& shapes() const { return shapes_; }

  /// Numbers of the joints that move, from the base on.
  /// @param base  a link; empty: the root
  /// @param tip   the end of the chain of joints; empty: all behind the base
  std::vector<std::size_t> moving(const std::string& base, const std::string& tip) const;

  /// The child of a joint in its parent's axes.
  /// @param position  [rad], of one that slides [m]; of one that does not move it is without
  /// meaning
  FramePose pose(std::size_t joint, double position) const;

 private:
  RobotFrames() = default;
  void add_bones();
  void add_behind(const std::string& link, std::vector<std::size_t>& found) const;

  std::string name_;
  std::vector<std::string> links_;
  std::vector<Joint> joints_;
  std::vector<LinkShape> shapes_;
};

}  // namespace armature::control
