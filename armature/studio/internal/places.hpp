// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "armature/base/result.hpp"

namespace armature::studio::internal {

/// Where a box is on the canvas, in steps of the grid's 8 pixels.
struct BoxPlace {
  std::int32_t x = 0;
  std::int32_t y = 0;
};

/// Where boxes are, and what moves robots in 3D: the file `FILE.studio.json` beside a deployment,
/// sorted, a line for each, so that what two people moved merges.
class Places {
 public:
  static constexpr std::int32_t kGrid = 8;

  /// Of the file's text; empty: nothing has a place. The error says what is wrong with it.
  static base::Result<Places> parse(const std::string& text);

  /// Coordinates in pixels go to the next step of the grid.
  void set(const std::string& box, double x, double y);
  /// The robot that `component` describes has the joint positions of `port`, `Sensor.Positions`;
  /// empty: those that are found.
  void move_by(const std::string& component, const std::string& port);
  void rename(const std::string& from, const std::string& to);
  /// What is inside of a box stands beside it, and the box goes.
  void dissolve(const std::string& box);
  void remove(const std::string& component);

  bool empty() const { return boxes_.empty() && robots_.empty(); }
  std::string to_text() const;

 private:
  std::map<std::string, BoxPlace> boxes_;
  std::map<std::string, std::string> robots_;  ///< ports, by the component that describes the robot
};

}  // namespace armature::studio::internal
