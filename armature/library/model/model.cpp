// SPDX-License-Identifier: Apache-2.0
#include "armature/library/model/model.hpp"

#include <algorithm>
#include <cmath>

#include "armature/library/base/reason_text.hpp"

namespace armature::library {

using component::Outcome;

Outcome Model::on_configure() {
  base::Diagnostics diagnostics;
  dynamics_ = control::InverseDynamics::load(
      description_, {.base_link = base_link_, .tip_link = tip_link_, .gravity = gravity_},
      diagnostics);
  if (Outcome outcome = tell(diagnostics); !outcome) return outcome;
  torques_.assign(dynamics_->joints(), 0.0);
  return check_joints();
}

/// Refuses with the first error, if there is one; warnings are logged.
Outcome Model::tell(const base::Diagnostics& diagnostics) {
  std::string first;
  for (const base::Diagnostic& each : diagnostics.all()) {
    if (each.severity == base::Severity::kWarning) log_warning("{}", each.message);
    if (each.severity == base::Severity::kError && first.empty()) first = base::to_text(each);
  }
  if (diagnostics.ok()) return component::accepted();
  const std::size_t more = diagnostics.error_count() - 1;
  if (more > 0) first += " (and " + std::to_string(more) + " more)";
  return component::refused(first);
}

Outcome Model::check_joints() const {
  if (dynamics_->joints() == static_cast<std::size_t>(joints_.get())) return component::accepted();
  std::string names;
  for (const std::string& name : dynamics_->joint_names()) {
    names += (names.empty() ? "" : ", ") + name;
  }
  return component::refused(description_.get() + " moves " + std::to_string(dynamics_->joints()) +
                            " joints, expected joints = " + std::to_string(joints_) + ": " + names);
}

void Model::compute(const std::vector<double>& motion) {
  const auto is_finite = [](double number) { return std::isfinite(number); };
  dynamics_->step(motion, torques_);
  if (std::all_of(torques_.begin(), torques_.end(), is_finite)) {
    out_.write(torques_);
    return;
  }
  const auto wrong = std::find_if_not(motion.begin(), motion.end(), is_finite);
  component::Reason why("the torques are not finite");
  if (wrong != motion.end()) {
    why.append(": number ");
    append_number(why, static_cast<double>(wrong - motion.begin() + 1)).append(" of In is ");
    append_number(why, *wrong);
  }
  fault(why);
}

}  // namespace armature::library
