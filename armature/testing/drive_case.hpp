// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "armature/base/time.hpp"
#include "armature/exec/application.hpp"

namespace armature::testing {

/// A kind of drive as a deployment has it. Positions in the units of its joints (rad or m).
struct DriveCase {
  using Joints = std::vector<double>;
  using Act = std::function<void(exec::Application&)>;

  std::string name;  ///< letters and digits
  std::string file;  ///< the deployment
  std::vector<std::string> library_folders{};
  std::vector<std::string> overrides{};
  std::vector<std::string> hardware{};  ///< components that are the drives or their host
  Joints away{};                        ///< a place that the joints are to go to and can
  double motion_time = 0.0;             ///< [s] of a motion there; 0: as fast as its limits allow
  double arrives_within = 0.02;         ///< of it, half a second after the motion
  /// In which it comes to rest when it is switched off in motion: longer without a brake.
  base::Duration rests_within = std::chrono::seconds(1);
  /// The farthest that a joint goes after an absurd reference: it brakes with what it may.
  double brakes_within = 2.0;
  double sinks = 0.0;  ///< [rad/s or m/s], at most, of a joint that is braked by its motor alone
  /// Its components stop at once. False: an orderly stop is a motion of its own.
  bool stops_at_once = true;
  /// After a fault the program is begun again: the hardware has lost where it is.
  bool begins_again = false;
  /// Before it can be armed, such as an operator who closes the arm's own safety circuit.
  Act prepare = [](exec::Application&) {};
  /// Where the joints really are; by default where the application believes them to be.
  std::function<Joints(exec::Application&)> positions{};
  /// Whether any drive has power, as the drives themselves have it; by default whether a component
  /// that is a JointHardware was switched on, and did not take to be switched off.
  std::function<bool(exec::Application&)> powered{};
  /// Of drives for which time passes also when nobody asks them for anything any more: the time
  /// that it is for them, and what has it pass until another.
  std::function<base::Time(exec::Application&)> time{};
  std::function<void(exec::Application&, base::Time)> pass{};
  /// In motion: no drive answers any more; by default their first component stops.
  Act silence{};
  /// In motion: a drive fails; by default its component throws.
  Act fail{};
  /// The cause of either is gone, and the operator does what the hardware's manual says; several
  /// times, as components come back one after the other.
  Act mend = [](exec::Application&) {};
};

/// What the test prints of it.
inline void PrintTo(const DriveCase& drive, std::ostream* out) { *out << drive.name; }
inline std::string by_name(const ::testing::TestParamInfo<DriveCase>& tested) {
  return tested.param.name;
}

}  // namespace armature::testing
