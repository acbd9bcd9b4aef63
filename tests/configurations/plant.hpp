// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "armature/document/document.hpp"
#include "armature/exec/application.hpp"

namespace armature::configurations {

using Vector = std::vector<double>;

/// A robot as it really is, whatever its components say: the simulation behind its hardware.
class Plant {
 public:
  Plant() = default;
  Plant(const Plant&) = delete;
  Plant& operator=(const Plant&) = delete;
  virtual ~Plant() = default;

  /// Time passes for it also where nobody asks it for anything any more.
  virtual void advance_to(base::Time now) = 0;
  /// Where its joints are [rad].
  virtual Vector positions() = 0;
  /// A motor is driven.
  virtual bool driven() = 0;
  /// The button that no software is between; false if it has none.
  virtual bool press_estop() { return false; }
};

/// A file, and what of it is set as on the command line.
struct Shipped {
  std::string file;
  std::vector<std::string> overrides{};
  bool has_robot = true;  ///< else it commands that of another process
};

/// What a robot may do at most, and how it is asked to move.
struct RobotUnderTest {
  const char* name;
  std::vector<Shipped> deployments;
  double most_speed;  ///< [rad/s] by its description, with what tracking adds
  Vector lower;       ///< [rad] by its description; empty: it has none
  Vector upper;
  Vector step;           ///< [rad] of the motion that is asked for
  double sinking;        ///< [rad/s] once let go; brakes: nearly none
  double braking = 0.5;  ///< [s] in which what is let go of in motion is as slow as it sinks
};

/// The same deployment on the simulated robot; nothing if it is of that already.
std::optional<document::Document> simulated(document::Document document);

/// The robot of `document`, whose components `application` has; one for each that there is hardware
/// of.
std::vector<std::unique_ptr<Plant>> plants_of(const document::Document& document,
                                              exec::Application& application);

RobotUnderTest janus();
RobotUnderTest wam4();
RobotUnderTest wam7();
RobotUnderTest own_robot();
/// Two drives by CiA 402, in each of their modes.
RobotUnderTest cia402_arm();
/// Its joints are the ways of its wheels [m].
RobotUnderTest rover();

}  // namespace armature::configurations
