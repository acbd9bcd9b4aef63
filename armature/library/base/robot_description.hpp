// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/component/author.hpp"
#include "armature/control/inverse_dynamics.hpp"
#include "armature/library/base/changes.hpp"

namespace armature::library {

/// The properties that say which robot a component computes the dynamics of.
class RobotDescription {
 public:
  explicit RobotDescription(component::Component* owner);

  /// Reads the description; an error if it cannot be read, is no URDF, or has another number of
  /// movable joints than `joints`.
  /// @param warnings  what else there is to say of it
  /// @thread configuration only
  base::Result<control::InverseDynamics> load(std::size_t joints,
                                              std::vector<std::string>& warnings) const;

  const std::string& file() const { return file_.get(); }
  /// Whether a property was set since this was asked.
  bool take_change() { return changes_.take(); }

 private:
  component::Property<std::string> file_;
  component::Property<std::string> base_link_;
  component::Property<std::string> tip_link_;
  component::Property<std::array<double, 3>> gravity_;
  Changes changes_{file_, base_link_, tip_link_, gravity_};
};

}  // namespace armature::library
