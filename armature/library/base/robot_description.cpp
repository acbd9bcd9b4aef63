// SPDX-License-Identifier: Apache-2.0
#include "armature/library/base/robot_description.hpp"

#include <optional>
#include <utility>

#include "armature/base/diagnostic.hpp"

namespace armature::library {
namespace {

/// The first error, if there is one; warnings are noted.
std::optional<base::Error> error_in(const base::Diagnostics& diagnostics,
                                    std::vector<std::string>& warnings) {
  std::string first;
  for (const base::Diagnostic& each : diagnostics.all()) {
    if (each.severity == base::Severity::kWarning) warnings.push_back(each.message);
    if (each.severity == base::Severity::kError && first.empty()) first = base::to_text(each);
  }
  if (diagnostics.ok()) return std::nullopt;
  const std::size_t more = diagnostics.error_count() - 1;
  if (more > 0) first += " (and " + std::to_string(more) + " more)";
  return base::Error{first};
}

}  // namespace

RobotDescription::RobotDescription(component::Component* owner)
    : file_(owner, "robot_description", "",
            "the robot's description (URDF), a file; a path counts from the working directory", "",
            component::mandatory),
      base_link_(owner, "base_link", "", "the link that stands still; empty: the root"),
      tip_link_(owner, "tip_link", "",
                "the end of the chain of joints; empty: the only end there is"),
      gravity_(owner, "gravity", {0.0, 0.0, -9.81}, "in the axes of the base link", "m/s^2") {}

base::Result<control::InverseDynamics> RobotDescription::load(
    std::size_t joints, std::vector<std::string>& warnings) const {
  base::Diagnostics diagnostics;
  auto dynamics = control::InverseDynamics::load(
      file_, {.base_link = base_link_, .tip_link = tip_link_, .gravity = gravity_}, diagnostics);
  if (auto error = error_in(diagnostics, warnings)) return *error;
  if (dynamics->joints() == joints) return std::move(*dynamics);
  std::string names;
  for (const std::string& name : dynamics->joint_names()) {
    names += (names.empty() ? "" : ", ") + name;
  }
  return base::Error{file_.get() + " moves " + std::to_string(dynamics->joints()) +
                     " joints, expected joints = " + std::to_string(joints) + ": " + names};
}

}  // namespace armature::library
