// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "armature/base/seconds.hpp"
#include "armature/component/author.hpp"
#include "armature/component/face.hpp"
#include "armature/control/arming/hand_over.hpp"
#include "armature/control/arming/reference_brake.hpp"
#include "armature/control/arming/resting_mean.hpp"
#include "armature/controllers/base/axis_units.hpp"
#include "armature/controllers/base/changes.hpp"
#include "armature/controllers/base/driven_joint.hpp"
#include "armature/controllers/base/max_age.hpp"
#include "armature/controllers/base/sample_input.hpp"
#include "armature/controllers/base/sampling_period.hpp"

namespace armature::controllers {

/// The controller of a robot with N joints (paper 1, figure 4): to be extended by a control law.
///
/// Each Sample enables one computation, on the `sensor` that comes after it (paper 1, sections 3
/// and 3.3.2). A `sensor` without one is counted, and nothing is computed. A controller that takes
/// over has the Sample of the one before.
///
/// A reference that is older than declared is not followed any more: the component stops, and so
/// do the joints. With MaxAcceleration they are braked smoothly instead, from the first sampling
/// period in which no reference comes, and once it is too old they are held until there is one
/// again that begins where they are (see control::ReferenceBrake).
///
/// If it takes over from another controller because modes are switched, `act` goes on from what
/// that one wrote last, at rest from the mean of what it wrote lately, and the difference dies away
/// in `SwitchTime`; arming ends that. A reference
/// that is far from where the joints are was not followed any more: with MaxAcceleration it is not
/// followed now either, and the joints are braked.
class Controller : public component::Component, public PassesSamples, public DrivesJoints {
 public:
  /// @param out_unit  of `act`, where the deployment does not say another one
  explicit Controller(std::string name, std::string out_unit = "V")
      : Component(std::move(name)),
        out_unit_(this, "OutUnit", std::move(out_unit), "of `act`: what the drives are given") {}

  std::vector<const component::InputPortBase*> samples_behind(
      const component::OutputPortBase& /*output*/) const override {
    return {&face(sensor_)};
  }
  /// Of `reference`: all of its joints.
  std::vector<DrivenJoint> joints_behind(const component::InputPortBase* input,
                                         const component::Check& check) override;

 protected:
  /// A sampling period begins; by default that is noted: it enables one computation, and those in
  /// which nothing was measured are counted. Whoever overrides it calls it.
  /// Runs in real time: nonblocking, no allocation.
  /// @thread the component's own
  virtual void sample_now();
  /// Computes the control signals of this sampling period and writes them with `drive`.
  /// @param measured  [q1..qN, d1..dN] [rad]
  /// Runs in real time: nonblocking, no allocation.
  /// @thread the component's own
  virtual void controller_now(const std::vector<double>& measured) = 0;

  /// Writes `act`.
  /// Runs in real time: nonblocking, no allocation.
  /// @thread the component's own
  void drive(const std::vector<double>& signals) {
    if (hand_over_.active()) [[unlikely]] {
      handed_over_ = signals;
      hand_over_.step(handed_over_, time(), base::from_seconds(switch_time_));
      write(handed_over_);
    } else {
      write(signals);
    }
  }

  /// Whoever overrides these calls them.
  component::Outcome on_configure() override;
  component::Outcome on_start() override;
  void on_check(component::Check& check) const override;

  /// What `act` drives; nothing if nobody says, or not as many joints as this has.
  /// @thread configuration only
  std::vector<DrivenJoint> driven_joints(const component::Check& check) const;
  /// The same as who has samples of its own knows them: not how late those of this one are.
  const std::vector<DrivenJoint>& acted_joints(const component::Check& check) const;
  /// By how many cycles samples come late.
  /// @thread configuration only
  int samples_late(const component::Check& check) const {
    return cycles_late(face(sensor_), check);
  }

  /// The gravity that its control signals hold the joints' weight against [m/s^2], 0 if they leave
  /// it to others; nothing: it has no model of it.
  /// @thread configuration only
  virtual std::optional<std::array<double, 3>> gravity_held(
      const component::Check& /*check*/) const {
    return std::nullopt;
  }

  /// What is to be followed in this sampling period; to be asked once in each. nullptr: nothing
  /// came yet since the start, or nothing is followed any more.
  /// @param measured  [q1..qN, d1..dN] [rad]
  /// Runs in real time: nonblocking, no allocation.
  const std::vector<double>* reference_now(const std::vector<double>& measured);

  AxisUnits units_{this, AxisUnit::Of::kAxes};
  component::Property<int> joints_{
      this, "joints", 1, "number of joints", "", component::mandatory, component::range(1, 100000)};
  component::Property<std::vector<double>> max_acceleration_{
      this,
      "MaxAcceleration",
      {},
      "with which a joint is braked when its reference stays away, one for each or one for all; "
      "none: the component stops then",
      "",
      component::unit_of(units_.acceleration())};
  SamplingPeriod period_{this, SamplingPeriod::Need::kIfAsked};  ///< with MaxAcceleration
  component::InputPort<std::vector<double>> reference_{
      this,
      "reference",
      "desired [q1..qN, qd1..qdN, qdd1..qddN]: rad, rad/s, rad/s^2",
      "",
      component::size_of(joints_, 3),
      component::max_age(kMaxAge, component::Reaction::kHold)};
  component::Property<std::string> out_unit_;
  component::OutputPort<std::vector<double>> act_{this,
                                                  "act",
                                                  "control signals [u1..uN]",
                                                  "",
                                                  component::unit_of(out_unit_),
                                                  component::size_of(joints_)};

 private:
  /// Refuses a weight that would be driven twice, or that everybody leaves to others.
  class WeightCheck final : public component::Checked {
   public:
    explicit WeightCheck(Controller& controller) : Checked(&controller), controller_(controller) {}
    void check(component::Check& check) const override;

   private:
    const Controller& controller_;
  };

  void sensor_arrived(const std::vector<double>& measured) {
    if (!std::exchange(sampled_, false)) [[unlikely]]
      return count_without_sample(measured);
    controller_now(measured);
  }
  void count_without_sample(const std::vector<double>& measured);
  component::Outcome set_up();
  void write(const std::vector<double>& signals) {
    lately_.add(signals, rests_);
    act_.write(signals);
  }
  const std::vector<double>* choose_reference(const std::vector<double>& measured);
  bool all_rest(const std::vector<double>& reference, const std::vector<double>& measured) const;
  void take_over();
  const Controller* predecessor() const;
  void begin_to_brake(const std::vector<double>& last, const std::vector<double>& measured);
  void know_motion(const std::vector<double>& measured);
  void take_over_reference(const std::vector<double>& measured);
  void forget_other() { hand_over_.reset(); }

  component::Property<double> switch_time_{this,
                                           "SwitchTime",
                                           0.5,
                                           "in which the difference to the controller before dies "
                                           "away when modes are switched; 0: a step",
                                           "s",
                                           component::range(0.0, 0.5),
                                           component::changeable_while_running};
  component::InputPort<std::vector<double>> sensor_{
      this,
      "sensor",
      "measured [q1..qN, d1..dN]: positions, then displacements since the sample before",
      "",
      component::on_data<&Controller::sensor_arrived>,
      component::size_of(joints_, 2),
      component::max_age(kMaxAge),
      component::unit_of(units_.position())};
  component::EventHandler<> sample_{this, "Sample", component::serve<&Controller::sample_now>,
                                    "a sampling period begins", component::optional};
  component::InputPort<std::uint64_t> sample_port_{
      this,
      "SamplePort",
      "the same from a port, as in paper 3: the number of the sample",
      "",
      component::on_data<&Controller::sample_now>,
      component::may_stay_open,
      component::on_lost(component::Reaction::kHold)};
  SampleInput sample_input_{this, sample_, sample_port_};
  component::Attribute<int> samples_without_sensor_{
      this, "samples_without_sensor", 0,
      "sampling periods since the start in which nothing was measured"};
  component::Attribute<int> sensor_without_sample_{
      this, "sensor_without_sample", 0,
      "values of `sensor` since the start that came without a Sample: nothing was computed"};
  component::EventHandler<> arm_{this,
                                 "Arm",
                                 component::serve<&Controller::forget_other>,
                                 "what the previous controller wrote no longer counts",
                                 component::optional,
                                 component::leads_to_nothing()};
  WeightCheck weight_check_{*this};
  control::HandOver hand_over_;
  control::RestingMean lately_;  ///< what was written, for who takes over
  bool has_successors_ = false;  ///< others write where this one does, in their turn
  bool rests_ = false;           ///< the joints, in this sampling period; told to successors only
  std::vector<double> handed_over_;
  std::vector<double> motion_;  ///< as measured, like a reference
  component::Attribute<int> brakings_{this, "brakings", 0,
                                      "how often since the start the reference stayed away"};
  Changes changes_{joints_, max_acceleration_, period_.property()};
  std::optional<control::ReferenceBrake> brake_;
  base::Time started_{};
  base::Time followed_{};  ///< when the reference was written that was followed last
  bool late_ = false;      ///< nothing came since, and it is not too old yet
  bool braking_ = false;
  bool takes_over_ = false;  ///< until the first sample
  bool sampled_ = false;     ///< and nothing computed since
};

}  // namespace armature::controllers
