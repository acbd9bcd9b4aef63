// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "armature/control/dynamics/inverse_dynamics.hpp"
#include "armature/control/dynamics/joint_inertias.hpp"
#include "armature/control/low_pass.hpp"
#include "armature/controllers/base/changes.hpp"
#include "armature/controllers/base/checked_gains.hpp"
#include "armature/controllers/base/controller.hpp"
#include "armature/controllers/base/robot_description.hpp"

namespace armature::controllers {

/// A controller that knows the robot's dynamics from its description, and how the joints move: to
/// be extended by a control law. Its control signals are torques at the joints; they are
/// limited where they are taken.
///
/// A velocity is a displacement by the Period. Its error behind a low pass counts as that of the
/// velocity: steps of encoders are smoothed, and a motion that is followed is not seen too late.
/// Nothing is driven before the first `reference` since the start; numbers that are not finite are
/// a fault.
class ControllerOfModel : public Controller {
 public:
  explicit ControllerOfModel(std::string name) : Controller(std::move(name), "Nm") {}

 protected:
  component::Outcome on_configure() final;
  component::Outcome on_start() final;
  void on_check(component::Check& check) const override { period_.expect_known(check); }
  std::optional<std::array<double, 3>> gravity_held(const component::Check& /*check*/) const final {
    return description_.gravity();
  }
  void controller_now(const std::vector<double>& measured) final;

  /// Makes the control law, from the properties.
  /// @thread configuration only
  virtual base::Result<void> make_law(control::InverseDynamics links) = 0;
  /// Whether a property of the law was set since this was asked.
  /// Runs in real time: nonblocking, no allocation.
  virtual bool take_change() = 0;
  /// @param reference  [q1..qN, qd1..qdN, qdd1..qddN]
  /// @param motion     measured [q1..qN, qd1..qdN]
  /// @param torques    [N m] one for each joint
  /// Runs in real time: nonblocking, no allocation.
  /// @thread the component's own
  virtual void compute(std::span<const double> reference, std::span<const double> motion,
                       std::span<double> torques) = 0;

  std::size_t joints() const { return static_cast<std::size_t>(joints_.get()); }

  // For the check of gains.
  /// The law of one joint as a loop sees it.
  control::SampledController::FilteredPd loop_of(double kp, double kd, double period_s,
                                                 const CheckedGains::Wanted& wanted) const {
    return {kp, kd, wanted.value_of(velocity_cutoff_), period_s};
  }
  /// What the model has the joints move, with rotors; nothing if it cannot be read.
  /// @thread configuration only: milliseconds
  std::vector<control::JointRange> model_ranges(const control::Transmission* rotors) const;
  component::Property<double>& velocity_cutoff() { return velocity_cutoff_; }

 private:
  component::Outcome set_up();
  bool take_any_change();
  void estimate_motion(const std::vector<double>& reference, const std::vector<double>& measured);

  component::Property<double> velocity_cutoff_{
      this,    "VelocityCutoff",
      180.0,   "corner of the low pass behind the errors of the velocities",
      "rad/s", component::range(0.001, 1e6)};
  RobotDescription description_{this};
  Changes changes_{joints_, period_.property(), velocity_cutoff_};
  std::vector<control::LowPass> filters_;
  bool filtered_before_ = false;
  std::vector<double> measured_motion_;  ///< [q, qd]
  std::vector<double> torques_;
};

}  // namespace armature::controllers
