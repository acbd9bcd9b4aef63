// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "armature/controllers/base/controller_of_pids.hpp"

namespace armature::controllers {

/// An independent PID for each joint: hands `reference` and `sensor` out to N PIDs and writes `act`
/// once all N have answered (paper 1, section 3.3.2, ControllerNPID). Of a PID that does not
/// answer see ControllerOfPids.
/// @rt nonblocking, no allocation, O(joints)
class ControllerNPID final : public ControllerOfPids {
 public:
  using ControllerOfPids::ControllerOfPids;

 private:
  void conclude(const std::vector<double>& answers) override { drive(answers); }
};

}  // namespace armature::controllers
