// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/base/controller_of_model.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "armature/controllers/base/reason_text.hpp"

namespace armature::controllers {

using component::Outcome;

Outcome ControllerOfModel::on_configure() {
  if (Outcome outcome = Controller::on_configure(); !outcome) return outcome;
  return set_up();
}

Outcome ControllerOfModel::on_start() {
  if (take_any_change()) {
    if (Outcome outcome = set_up(); !outcome) return outcome;
  }
  filtered_before_ = false;
  return Controller::on_start();
}

Outcome ControllerOfModel::set_up() {
  if (Outcome outcome = period_.known(); !outcome) return outcome;
  std::vector<std::string> warnings;
  auto links = description_.load(joints(), warnings);
  for (const std::string& warning : warnings) log_warning("{}", warning);
  if (!links) return component::refused(links.error());
  if (const auto made = make_law(std::move(links).value()); !made) {
    return component::refused(made.error());
  }
  const auto filter =
      control::LowPass::make({.omega = velocity_cutoff_, .period_s = period_.seconds()});
  if (!filter) return component::refused(filter.error());
  filters_.assign(joints(), filter.value());
  measured_motion_.assign(2 * joints(), 0.0);
  torques_.assign(joints(), 0.0);
  take_any_change();
  return component::accepted();
}

bool ControllerOfModel::take_any_change() {
  const bool own = changes_.take(), described = description_.take_change(), law = take_change();
  return own || described || law;
}

void ControllerOfModel::controller_now(const std::vector<double>& measured) {
  const std::vector<double>* const reference = reference_now(measured);
  if (reference == nullptr) return;
  estimate_motion(*reference, measured);
  compute(*reference, measured_motion_, torques_);
  const auto wrong = std::find_if_not(torques_.begin(), torques_.end(),
                                      [](double torque) { return std::isfinite(torque); });
  if (wrong == torques_.end()) {
    drive(torques_);
    return;
  }
  component::Reason why("the torque of joint ");
  append_number(why, static_cast<double>(wrong - torques_.begin() + 1)).append(" is ");
  append_number(why, *wrong);
  fault(why.append(", expected finite numbers in reference and sensor"));
}

void ControllerOfModel::estimate_motion(const std::vector<double>& reference,
                                        const std::vector<double>& measured) {
  const std::size_t count = joints();
  const double period_s = period_.seconds();
  const bool first = !std::exchange(filtered_before_, true);
  for (std::size_t i = 0; i < count; ++i) {
    const double desired = reference[count + i];
    const double error = desired - measured[count + i] / period_s;
    if (first) filters_[i].reset_to(error);
    measured_motion_[i] = measured[i];
    measured_motion_[count + i] = desired - filters_[i].step(error);
  }
}

std::vector<control::JointRange> ControllerOfModel::model_ranges(
    const control::Transmission* rotors) const {
  std::vector<std::string> warnings;
  auto links = description_.load(joints(), warnings);
  if (!links) return {};
  return control::find_joint_ranges(links.value(), rotors, control::search_limits(links.value()));
}

}  // namespace armature::controllers
