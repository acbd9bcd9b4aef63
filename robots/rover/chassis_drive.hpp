// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/fixed_text.hpp"
#include "armature/component/author.hpp"
#include "armature/control/arming/gathering.hpp"
#include "armature/controllers/base/changes.hpp"
#include "armature/controllers/base/checked_gains.hpp"
#include "armature/controllers/base/missing_answers.hpp"
#include "armature/controllers/base/sampling_period.hpp"
#include "robots/rover/odometry.hpp"
#include "robots/rover/speed_ramp.hpp"

namespace armature::rover {

/// Why a chassis came to rest; as long as a text of an event may be.
using StopReason = base::FixedText<127>;

/// What a chassis with wheels on both sides does with the speeds of its sides (paper 4, section
/// II.A and table 4): `setVelocity(left, right)` whether it has two wheels or four. For each of its
/// wheels there are a Joint and a VelocityPID, which follows `Ref`.
///
/// Speeds come by `setVelocity` or by the ports, the last one counts, and for 200 ms: what is not
/// renewed ends in a smooth stop. So does a number that is none. Speeds above MaxSpeed are lowered
/// together, so that the curve stays. Nothing is followed while a joint is disarmed.
///
/// In each Sample it waits for the positions of all wheels, then raises Act, so that all joints
/// apply their voltages together. A wheel that is not measured in some samples in a row, or does
/// not follow for a time, is a fault that names it, and all joints are disarmed with it.
/// @rt nonblocking, no allocation, O(wheels)
class ChassisDrive final : public component::Component {
 public:
  using Component::Component;

 private:
  static constexpr base::Duration kRenewal = std::chrono::milliseconds(200);

  component::Outcome on_configure() override { return set_up(); }
  component::Outcome on_start() override;
  void on_check(component::Check& check) const override;
  component::Outcome set_up();

  std::vector<controllers::DrivenJoint> joints(const component::Check& check);
  static std::string objection(const std::vector<controllers::DrivenJoint>& joints, double speed,
                               double radius);

  // A cycle.
  void on_sample();
  void on_position(std::size_t wheel, double position);
  void cycle();
  void measure();
  void look_at_ports();
  void check_age();
  void drive();
  void watch_wheels();
  void tell();
  void tell_armed(std::size_t wheel, bool armed);

  // What is wanted.
  component::Outcome set_velocity(float left, float right);
  bool want(const Speeds& speeds, base::Time at, std::string_view left, std::string_view right);
  void stop_smoothly(std::string_view why);
  void stop_at_once(std::string_view why);
  void tell_stop(std::string_view why);
  void settle();
  void brake() { stop_smoothly("Arming.stop was called"); }
  std::size_t first_disarmed();
  void fail(std::size_t wheel, std::string_view what);

  std::size_t wheels() const { return static_cast<std::size_t>(wheels_.get()); }
  static std::size_t side_of(std::size_t wheel) { return wheel % 2; }

  component::Property<int> wheels_{
      this, "Wheels", 2, "2 or 4; odd ones are on the left", "", component::range(2, 4)};
  component::Property<double> wheel_radius_{
      this, "WheelRadius", 0.05, "of each wheel", "m", component::range(0.001, 10.0)};
  component::Property<double> track_{
      this, "Track", 0.3, "between left and right wheels", "m", component::range(0.01, 10.0)};
  component::Property<double> max_speed_{this,
                                         "MaxSpeed",
                                         0.6,
                                         "of each side",
                                         "m/s",
                                         component::range(0.001, 10.0),
                                         component::changeable_while_running};
  component::Property<double> max_acceleration_{this,    "MaxAcceleration",
                                                2.0,     "with which speeds are followed",
                                                "m/s^2", component::range(0.01, 100.0)};
  component::Property<double> stop_deceleration_{this,    "StopDeceleration",
                                                 1.0,     "with which it stops smoothly",
                                                 "m/s^2", component::range(0.01, 100.0)};
  component::Property<double> max_error_{
      this,  "MaxSpeedError",
      0.25,  "a wheel that is farther from its speed for a time has failed",
      "m/s", component::range(0.01, 10.0)};
  component::Property<double> error_time_{
      this, "SpeedErrorTime", 0.3, "that time", "s", component::range(0.02, 10.0)};
  controllers::SamplingPeriod period_{this};
  controllers::MissingAnswers missing_{this};

  component::InputPort<double> left_{this,
                                     "VelocityLeft",
                                     "wanted speed of the left side",
                                     "m/s",
                                     component::max_age(kRenewal, component::Reaction::kHold),
                                     component::on_lost(component::Reaction::kHold),
                                     component::may_stay_open};
  component::InputPort<double> right_{this,
                                      "VelocityRight",
                                      "wanted speed of the right side",
                                      "m/s",
                                      component::max_age(kRenewal, component::Reaction::kHold),
                                      component::on_lost(component::Reaction::kHold),
                                      component::may_stay_open};
  component::InputPorts<double> position_{this,
                                          "Position",
                                          wheels_,
                                          "of each wheel's joint",
                                          "rad",
                                          component::on_data<&ChassisDrive::on_position>,
                                          component::on_lost(component::Reaction::kHold)};
  component::InputPorts<bool> joint_armed_{this,
                                           "JointArmed",
                                           wheels_,
                                           "each joint is armed",
                                           "",
                                           component::on_data<&ChassisDrive::tell_armed>,
                                           component::leads_to("Armed"),
                                           component::on_lost(component::Reaction::kHold)};

  component::OutputPorts<double> reference_{this, "Ref", wheels_, "for each wheel", "rad/s"};
  component::OutputPort<double> speed_left_{this, "SpeedLeft", "of the left side's wheels", "m/s"};
  component::OutputPort<double> speed_right_{this, "SpeedRight", "of the right side's wheels",
                                             "m/s"};
  component::OutputPort<double> x_{this, "X", "by the wheels, from where it began, to its front",
                                   "m"};
  component::OutputPort<double> y_{this, "Y", "by the wheels, to the left of where it began", "m"};
  component::OutputPort<double> heading_{this, "Heading", "by the wheels, to the left", "rad"};
  component::OutputPort<bool> armed_{this, "Armed", "all joints are armed"};
  // For Arming, of which the chassis is one axis.
  component::OutputPort<std::vector<double>> axis_position_{
      this, "nAxesSensorPosition", "mean of the wheels", "rad", component::fixed_size(1)};
  component::OutputPort<std::vector<double>> axis_desired_{
      this, "nAxesDesiredPosition", "the same, and at rest where it came to rest", "rad",
      component::fixed_size(1)};
  component::OutputPort<std::vector<double>> axis_velocity_{this, "nAxesDesiredVelocity",
                                                            "desired of the fastest wheel", "rad/s",
                                                            component::fixed_size(1)};

  component::Event<> act_{this, "Act", "all joints apply their voltages"};
  component::Event<StopReason> stopped_{
      this, "Stopped", "it came to rest, or is about to", {"reason"}};
  component::EventHandler<> sample_{this, "Sample", component::serve<&ChassisDrive::on_sample>,
                                    "a sampling period begins", component::leads_to_nothing()};
  component::EventHandler<> settle_{this, "Settle", component::serve<&ChassisDrive::settle>,
                                    "nothing is wanted any more", component::leads_to("Stopped")};
  component::EventHandler<> brake_{this, "Stop", component::serve<&ChassisDrive::brake>,
                                   "smooth stop", component::leads_to("Stopped")};
  component::OperationCaller<void()> disarm_{this, "disarm", "disarms all joints"};
  component::Command<float, float> set_velocity_{
      this, "setVelocity", component::serve<&ChassisDrive::set_velocity>,
      "drives with these speeds for 200 ms; renew it to go on",
      component::args("left [m/s]", "right [m/s]")};

  component::Attribute<StopReason> stop_reason_{this, "stop_reason", StopReason(),
                                                "why it came to rest last"};

  controllers::CheckedGains limits_{
      this, [this](const component::Check& check) { return joints(check); },
      [this](const std::vector<controllers::DrivenJoint>& joints, double /*period_s*/,
             const controllers::CheckedGains::Wanted& wanted) {
        return objection(joints, wanted.value_of(max_speed_), wanted.value_of(wheel_radius_));
      },
      max_speed_, wheel_radius_};
  controllers::Changes changes_{wheels_,           wheel_radius_,      track_,
                                max_acceleration_, stop_deceleration_, period_.property()};
  std::optional<control::Gathering> gathering_;
  std::optional<Odometry> odometry_;
  SpeedRamp ramp_;
  bool moving_ = false;  ///< something is wanted, and renewed
  base::Time wanted_at_{};
  Speeds wanted_;
  Speeds measured_;                  ///< of the sides [m/s]
  std::vector<double> last_;         ///< positions of the sample before
  std::vector<double> wheel_speed_;  ///< [m/s]
  std::vector<base::Time> good_at_;  ///< when each wheel followed last
  std::vector<double> desired_velocity_;
  std::vector<double> axis_{0.0};          ///< mean position of the wheels [rad]
  std::vector<double> axis_resting_{0.0};  ///< where it came to rest
  std::vector<double> axis_wanted_{0.0};   ///< speed of the fastest wheel [rad/s]
  bool has_last_ = false;
};

}  // namespace armature::rover
