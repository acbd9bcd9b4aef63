// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/computed_torque/controller_computed_torque.hpp"

#include <algorithm>
#include <utility>

#include "armature/control/per_joint.hpp"

namespace armature::controllers {
namespace {

/// By how much a model may be wrong.
constexpr double kAlike = 1.5;

}  // namespace

base::Result<void> ControllerComputedTorque::make_law(control::InverseDynamics links) {
  const auto kp = control::per_joint(kp_.name(), kp_.get(), joints());
  if (!kp) return base::Error{kp.error()};
  const auto kd = control::per_joint(kd_.name(), kd_.get(), joints());
  if (!kd) return base::Error{kd.error()};
  auto rotors = motors({});
  if (!rotors) return base::Error{rotors.error()};
  auto made = control::ComputedTorque::make(std::move(links), std::move(rotors).value(),
                                            {.kp = kp.value(), .kd = kd.value()});
  if (!made) return base::Error{made.error()};
  law_ = std::move(made).value();
  return {};
}

base::Result<control::Transmission> ControllerComputedTorque::motors(
    const CheckedGains::Wanted& wanted) const {
  auto inertia =
      control::per_joint(rotor_inertia_.name(), wanted.value_of(rotor_inertia_), joints());
  if (!inertia) return base::Error{inertia.error()};
  auto friction = control::per_joint(friction_.name(), wanted.value_of(friction_), joints());
  if (!friction) return base::Error{friction.error()};
  std::vector<double> turns = wanted.value_of(turns_);
  if (turns.size() == 1) turns.assign(joints(), turns.front());
  auto motors = control::Transmission::make({.turns = turns,
                                             .rotor_inertia = std::move(inertia).value(),
                                             .viscous_friction = std::move(friction).value()});
  if (!motors) return base::Error{"of the motors: " + motors.error()};
  return motors;
}

std::vector<DrivenJoint> ControllerComputedTorque::joints_and_model(const component::Check& check) {
  std::vector<DrivenJoint> joints = driven_joints(check);
  model_.clear();
  checked_motors_.reset();
  if (joints.empty()) return joints;
  if (auto rotors = motors({})) {
    model_ = model_ranges(&rotors.value());
    checked_motors_ = std::move(rotors).value();
  }
  return joints;
}

/// By an exact model each joint is as if it had an inertia of 1. Other motors than were checked
/// change what the model has the joint move by what they add to its diagonal.
std::string ControllerComputedTorque::objection(const std::vector<DrivenJoint>& joints,
                                                double period_s,
                                                const CheckedGains::Wanted& wanted) const {
  const auto kp = control::per_joint(kp_.name(), wanted.value_of(kp_), joints.size());
  if (!kp) return kp.error();
  const auto kd = control::per_joint(kd_.name(), wanted.value_of(kd_), joints.size());
  if (!kd) return kd.error();
  const auto rotors = motors(wanted);
  if (!rotors) return rotors.error();
  for (std::size_t i = 0; i < joints.size() && i < model_.size(); ++i) {
    const double more = rotors.value().rotor_inertia(i, i) - checked_motors_->rotor_inertia(i, i);
    const auto law = [&](double inertia) {
      const double moved = std::max(inertia + more, 0.0);
      return control::SampledController::of(
          loop_of(moved * kp.value()[i], moved * kd.value()[i], period_s, wanted));
    };
    std::string wrong = objection_to_gains(joints[i], law(model_[i].least_inertia),
                                           law(model_[i].most_inertia), period_s);
    if (wrong.empty()) wrong = objection_to_friction(joints[i], rotors.value(), i);
    if (!wrong.empty()) return wrong;
  }
  return {};
}

/// What drives against more friction than there is drives the joint away.
std::string ControllerComputedTorque::objection_to_friction(const DrivenJoint& joint,
                                                            const control::Transmission& rotors,
                                                            std::size_t number) {
  const std::vector<double> still(rotors.joints(), 0.0);
  std::vector<double> turning = still, torques = still;
  turning[number] = 1.0;
  rotors.add_rotor_torques(turning, still, torques);
  const double computed = torques[number];
  const double most = kAlike * joint.heaviest.damping;
  if (computed <= most) return {};
  return joint.name + ": motor_viscous_friction is " + figure(computed) +
         " Nm s/rad at the joint, expected at most " + figure(most) + ", as its drive has " +
         figure(joint.heaviest.damping);
}

void ControllerComputedTorque::compute(std::span<const double> reference,
                                       std::span<const double> motion, std::span<double> torques) {
  law_->step(reference, motion, torques);
}

}  // namespace armature::controllers
