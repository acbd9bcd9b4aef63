// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/control/pid.hpp"
#include "armature/controllers/base/axis_units.hpp"
#include "armature/controllers/base/changes.hpp"
#include "armature/controllers/base/checked_gains.hpp"
#include "armature/controllers/base/driven_joint.hpp"
#include "armature/controllers/base/max_age.hpp"
#include "armature/controllers/base/sampling_period.hpp"

namespace armature::controllers {

/// The controller of a joint that follows a velocity, such as a wheel: control::Pid (paper 1,
/// equation 6) on the error of the velocity, which is the joint's displacement by the period. One
/// step for each displacement, with the latest reference; nothing before the first reference since
/// the start. Its output is saturated and winds up in no case: a wheel that was held does not catch
/// up. Arming forgets the past. A difference that is no finite number is a fault, and nothing is
/// written.
///
/// Where the deployment says what the joint is (see Robot), gains that would shake it are refused,
/// at check and at any time after it.
/// @rt nonblocking, no allocation
class VelocityPid final : public component::Component, public DrivesJoints {
 public:
  using Component::Component;

  std::vector<DrivenJoint> joints_behind(const component::InputPortBase* input,
                                         const component::Check& check) override;

 private:
  component::Outcome on_configure() override { return set_up(); }
  component::Outcome on_start() override;
  void on_check(component::Check& check) const override;
  component::Outcome set_up();
  void step(double displacement);
  void reset();
  std::vector<DrivenJoint> joints(const component::Check& check);
  static std::string objection(const DrivenJoint& joint, double period_s,
                               const control::Pid::Config& gains);

  static constexpr component::Range kGains{0.0, 1e9};

  using Config = control::Pid::Config;
  component::Property<std::string> out_unit_{this, "OutUnit", "V",
                                             "of Out, UMin, UMax: what the drive is given"};
  AxisUnits units_{this, AxisUnit::Of::kOneAxis};
  DerivedUnit gains_unit_{this, {&units_.position(), &out_unit_}, [this] {
                            return gain_unit(out_unit_.get(), units_.position().get(), "s");
                          }};
  component::Properties<Config> config_{
      this,
      {.u_min = -1.0, .u_max = 1.0},
      component::member(&Config::kp, "Kp", "proportional gain", "", kGains,
                        component::unit_of(gains_unit_)),
      component::member(&Config::ki, "Ki", "integral gain, of one sample: the period is part of it",
                        "", kGains, component::unit_of(gains_unit_)),
      component::member(&Config::u_min, "UMin", "lower limit of the output", "",
                        component::mandatory, component::unit_of(out_unit_)),
      component::member(&Config::u_max, "UMax", "upper limit of the output", "",
                        component::mandatory, component::unit_of(out_unit_))};
  SamplingPeriod period_{this};
  component::InputPort<double> reference_{this,
                                          "Ref",
                                          "desired velocity",
                                          "",
                                          component::unit_of(units_.velocity()),
                                          component::max_age(kMaxAge)};
  component::InputPort<double> measured_{this,
                                         "Sen",
                                         "displacement since the sample before",
                                         "",
                                         component::unit_of(units_.position()),
                                         component::on_data<&VelocityPid::step>,
                                         component::max_age(kMaxAge)};
  component::OutputPort<double> output_{this, "Out", "control signal", "",
                                        component::unit_of(out_unit_)};
  component::EventHandler<> arm_{this,
                                 "Arm",
                                 component::serve<&VelocityPid::reset>,
                                 "forgets the past",
                                 component::optional,
                                 component::leads_to_nothing()};
  CheckedGains gains_{this, [this](const component::Check& check) { return joints(check); },
                      [this](const std::vector<DrivenJoint>& joints, double period_s,
                             const CheckedGains::Wanted& wanted) {
                        return objection(joints.front(), period_s, wanted.value_of(config_));
                      },
                      config_};
  Changes changes_{config_, period_.property()};
  std::optional<control::Pid> pid_;
  base::Time started_{};
};

}  // namespace armature::controllers
