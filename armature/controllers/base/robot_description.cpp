// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/base/robot_description.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <utility>

#include "armature/base/diagnostic.hpp"
#include "armature/controllers/base/driven_joint.hpp"

namespace armature::controllers {
namespace {

/// [m/s^2]
constexpr double kLeastGravity = 9.7;
constexpr double kMostGravity = 9.9;

using File = component::Property<std::string>;
constexpr const char* kFile = "robot_description";
constexpr const char* kDoc =
    "the robot's description (URDF), a file; a path counts from the working directory";

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

RobotDescription::RobotDescription(component::Component* owner, Need need)
    : Checked(owner),
      file_(need == Need::kMandatory ? File(owner, kFile, "", kDoc, "", component::mandatory)
                                     : File(owner, kFile, "", kDoc)),
      base_link_(owner, "base_link", "", "the link that stands still; empty: the root"),
      tip_link_(owner, "tip_link", "",
                "the end of the chain of joints; empty: the only end there is"),
      gravity_(owner, "gravity", {0.0, 0.0, -9.81}, "in the axes of the base link", "m/s^2") {
  for (component::PropertyBase* const each : std::initializer_list<component::PropertyBase*>{
           &file_, &base_link_, &tip_link_, &gravity_}) {
    each->add_follower(*this);
  }
}

std::string RobotDescription::objection() const {
  if (!checked_) return {};
  return "gains, limits and what holds the weight were checked for this robot; set it in the "
         "deployment, which is checked again";
}

void RobotDescription::check(component::Check& check) const {
  checked_ = true;
  const auto& [x, y, z] = gravity_.get();
  const double size = std::hypot(x, y, z);
  if (!std::isfinite(size)) {
    return check.error("gravity is [" + figure(x) + ", " + figure(y) + ", " + figure(z) +
                       "] m/s^2, expected finite numbers");
  }
  if (size == 0.0 || (size >= kLeastGravity && size <= kMostGravity)) return;
  check.error("gravity is [" + figure(x) + ", " + figure(y) + ", " + figure(z) +
                  "] m/s^2, in size " + figure(size) + ", expected " + figure(kLeastGravity) +
                  " to " + figure(kMostGravity) + " as everywhere on earth, or 0",
              "0 is for those whose weight others hold; a base that hangs or leans has another "
              "direction, not another size");
}

base::Result<control::InverseDynamics> RobotDescription::load(
    std::size_t joints, std::vector<std::string>& warnings) const {
  const bool finite =
      std::ranges::all_of(gravity_.get(), [](double g) { return std::isfinite(g); });
  if (!finite) return base::Error{"gravity is not a finite number"};
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

}  // namespace armature::controllers
