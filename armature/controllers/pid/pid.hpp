// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/component/face.hpp"
#include "armature/control/arming/gain_fade.hpp"
#include "armature/control/pid.hpp"
#include "armature/controllers/base/axis_units.hpp"
#include "armature/controllers/base/checked_gains.hpp"
#include "armature/controllers/base/max_age.hpp"

namespace armature::controllers {

/// The PID controller of one joint with a saturated output, in velocity form (paper 1, equation 6):
/// control::Pid. One step for each value of Sen; nothing before the first value of Ref since the
/// start. Neither a start nor `reset` kicks, and so it is when a
/// robot is armed (see Arming). A difference that is no finite number is a fault, and nothing is
/// written. If it takes over the place of another writer of its output because modes are switched,
/// it goes on from what that one wrote last. Gains that are changed while it runs become the new
/// ones in GainFadeTime.
///
/// Where the deployment says what the joint is (see Robot), gains that would shake it are refused,
/// at check and at any time after it.
///
/// With `PeerName` it has a joint of its own (paper 2, section 5.2): each update has that joint
/// read its sensor, and each output is set there.
/// @rt nonblocking, no allocation; with a joint in another thread it waits for that
class Pid final : public component::Component, public ControlsJoint, public DrivesJoints {
 public:
  using Component::Component;

  const component::InputPortBase& desired_input() const override { return face(reference_); }
  const component::InputPortBase& measured_input() const override { return face(measured_); }
  std::vector<DrivenJoint> joints_behind(const component::InputPortBase* input,
                                         const component::Check& check) override;

 private:
  component::Outcome on_start() override;
  void on_check(component::Check& check) const override;
  void on_update() override;
  void step(double measured);
  void expect_done(component::CallStatus status, std::string_view operation);
  void take_over(double output);
  void reset();
  void take_gains();
  std::vector<DrivenJoint> joints(const component::Check& check);
  std::string objection(const DrivenJoint& joint, double period_s,
                        const CheckedGains::Wanted& wanted) const;

  static constexpr component::Range kGains{0.0, 1e9};
  static constexpr component::ChangeableWhileRunning kLive{};

  using Config = control::Pid::Config;
  component::Property<std::string> out_unit_{this, "OutUnit", "V",
                                             "of Out, UMin, UMax: what the drive is given"};
  AxisUnit unit_{this, AxisUnit::Of::kOneAxis};
  DerivedUnit gains_unit_{
      this, {&unit_, &out_unit_}, [this] { return gain_unit(out_unit_.get(), unit_.get()); }};
  component::Properties<Config> config_{
      this,
      {.u_min = -1.0, .u_max = 1.0},
      component::member(&Config::kp, "Kp", "proportional gain", "", kGains, kLive,
                        component::unit_of(gains_unit_)),
      component::member(&Config::ki, "Ki", "integral gain, of one sample: the period is part of it",
                        "", kGains, kLive, component::unit_of(gains_unit_)),
      component::member(&Config::kd, "Kd",
                        "differential gain, of one sample: the period is part of it", "", kGains,
                        kLive, component::unit_of(gains_unit_)),
      component::member(&Config::u_min, "UMin", "lower limit of the output", "",
                        component::mandatory, component::unit_of(out_unit_)),
      component::member(&Config::u_max, "UMax", "upper limit of the output", "",
                        component::mandatory, component::unit_of(out_unit_))};
  component::Property<double> gain_fade_time_{
      this, "GainFadeTime",
      0.2,  "in which gains that are changed in motion become the new ones",
      "s",  component::range(0.0, 60.0)};
  component::Property<std::string> peer_name_{
      this, "PeerName", "", "the joint that it reads and drives itself; none: others do"};
  component::InputPort<double> reference_{
      this, "Ref", "desired position", "", component::unit_of(unit_), component::max_age(kMaxAge)};
  component::InputPort<double> measured_{this,
                                         "Sen",
                                         "measured position",
                                         "",
                                         component::unit_of(unit_),
                                         component::on_data<&Pid::step>,
                                         component::max_age(kMaxAge)};
  component::OutputPort<double> output_{this, "Out", "control signal", "",
                                        component::unit_of(out_unit_)};
  component::Operation<void()> reset_{this, "reset", component::serve<&Pid::reset>,
                                      "forgets the past: the next output is Ki e",
                                      component::in_own_thread};
  component::EventHandler<> arm_{this,
                                 "Arm",
                                 component::serve<&Pid::reset>,
                                 "forgets the past: the next output is Ki e",
                                 component::optional,
                                 component::leads_to_nothing()};

  component::OperationCaller<double()> read_sensor_{this, "sensorRead", "has the joint measure",
                                                    component::from(peer_name_),
                                                    component::optional};
  component::OperationCaller<bool(double)> motor_set_{
      this, "motorSet", "drives the joint", component::from(peer_name_), component::optional};

  CheckedGains gains_{this, [this](const component::Check& check) { return joints(check); },
                      [this](const std::vector<DrivenJoint>& joints, double period_s,
                             const CheckedGains::Wanted& wanted) {
                        return objection(joints.front(), period_s, wanted);
                      },
                      config_};
  std::optional<control::Pid> pid_;
  control::GainFade fade_;
  base::Time started_{};
};

}  // namespace armature::controllers
