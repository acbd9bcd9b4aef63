// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/model/model.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "armature/component/face.hpp"
#include "armature/controllers/base/driven_joint.hpp"
#include "armature/controllers/base/reason_text.hpp"

namespace armature::controllers {

using component::Outcome;

Outcome Model::on_configure() {
  std::vector<std::string> warnings;
  auto loaded = description_.load(static_cast<std::size_t>(joints_.get()), warnings);
  for (const std::string& warning : warnings) log_warning("{}", warning);
  if (!loaded) return component::refused(loaded.error());
  dynamics_ = std::move(loaded).value();
  torques_.assign(dynamics_->joints(), 0.0);
  return component::accepted();
}

/// The base is mounted in one way, whoever computes with it.
void Model::on_check(component::Check& check) const {
  const auto is_zero = [](double number) { return number == 0.0; };
  if (std::ranges::all_of(description_.gravity(), is_zero)) return;
  for (const DrivenJoint& joint : joints_behind(face(out_), check)) {
    if (std::ranges::all_of(joint.gravity, is_zero)) continue;  // nobody knows how it is mounted
    const std::string wrong = objection_to_gravity(joint, description_.gravity());
    if (wrong.empty()) continue;
    return check.error(wrong,
                       "gravity is in the axes of the base link: the same for all who compute it");
  }
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

}  // namespace armature::controllers
