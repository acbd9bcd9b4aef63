// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/controllers/base/joint_hardware.hpp"
#include "robots/janus/aic/aic_host.hpp"

namespace armature::janus {

/// One AIC card: the hardware of a joint. Its peer is the host of the bus that the card is on; how
/// motor and encoder are wired to it is what the models `AIC` and `AICCard` ask for, each in its
/// way.
///
/// It faults, and so stops its joint, when the bus is gone, when the card restarted (what moved
/// meanwhile is not known) and when the card switched its actuator off by itself. A report that was
/// lost on the bus has taken its counts along: that is counted and told, and `position_exact` says
/// so until the operator has confirmed where the joint is: before that it is not armed again.
class AicOfAJoint : public controllers::JointHardware {
 public:
  using JointHardware::JointHardware;

  HomingSigns homing_signs() const override { return {.home_switch = true}; }

 protected:
  struct Wiring {
    bool motor_inverted = false;     ///< a positive voltage is sent as a negative one
    double displacement_sign = 1.0;  ///< -1: the encoder counts the other way
    double motion = 1.0;             ///< of what DisplacementSensor tells, for one of the encoder
  };
  /// What is wrong with it is refused.
  virtual component::Outcome expect_wiring() const { return component::accepted(); }
  virtual Wiring wiring() const = 0;

 private:
  component::Outcome on_configure() override;
  component::Outcome on_start() override;

  bool actuator_on() override;
  bool actuator_off() override;
  bool actuator_set(control::LimitedEffort effort) override;
  bool sensor_read() override;
  bool brake_apply() override { return !brake_ || command(AicCommand::kBrakeApply); }
  bool brake_release() override { return !brake_ || energize(AicCommand::kBrakeRelease); }

  bool command(AicCommand command);
  bool energize(AicCommand command);
  bool usable(const AicSample& sample);
  void note_lost_counts();

  component::Property<int> number_{this,
                                   "JointNumber",
                                   1,
                                   "of the card",
                                   "",
                                   component::mandatory,
                                   component::range(1, kMostCards)};
  component::Property<bool> brake_{this, "Brake", false, "the joint has a brake"};
  component::Property<double> counts_per_turn_{
      this, "CountsPerTurn", 2000.0, "of the encoder", "", component::range(1.0, 1e9)};
  component::OperationCaller<AicSample(int)> read_card_{this, "readCard", "has the card read"};
  component::OperationCaller<bool(int, control::LimitedEffort)> set_motor_{
      this, "setMotor", "sets the card's motor value"};
  component::OperationCaller<bool(int, int)> command_card_{this, "commandCard",
                                                           "switches the card off, brakes it"};
  component::OperationCaller<bool(int, int, control::DrivePermit)> energize_card_{
      this, "energizeCard", "switches the card on, opens its brake"};

  double rad_per_count_ = 0.0;
  bool motor_inverted_ = false;
  bool on_ = false;  ///< switched on, as far as this side knows
};

/// The model `AIC`: DisplacementSensor is of the motor's axis, and its Joint has the gear.
class Aic final : public AicOfAJoint {
 public:
  using AicOfAJoint::AicOfAJoint;

 private:
  component::Outcome expect_wiring() const override;
  Wiring wiring() const override;

  component::Property<double> motor_sign_{this, "MotorSign", 1.0,
                                          "-1 if the motor is wired the other way"};
  component::Property<double> encoder_sign_{this, "EncoderSign", 1.0,
                                            "-1 if the encoder is wired the other way"};
  component::Property<double> gear_ratio_{this, "GearRatio", 1.0,
                                          "motion of the motor's axis per motion of the encoder"};
};

/// The model `AICCard`, with the properties of paper 2, section 5.1: DisplacementSensor is of the
/// robot's axis. Its Joint has the GearRatio 1; the composite `AIC` of deployments/aic.yaml is
/// both.
class AicWithGear final : public AicOfAJoint {
 public:
  using AicOfAJoint::AicOfAJoint;

  double sensor_turns() const override { return 1.0 / gear_ratio_; }

 private:
  Wiring wiring() const override;

  component::Property<bool> motor_sign_{this, "MotorSign", false,
                                        "inverts the voltage that is applied"};
  component::Property<bool> encoder_sign_{this, "EncoderSign", false,
                                          "inverts the readings of the encoder"};
  component::Property<double> gear_ratio_{
      this,
      "GearRatio",
      1.0,
      "turns of the motor, which has the encoder, for one of the robot's axis: readings are "
      "divided by it",
      "",
      component::mandatory,
      component::range(1e-6, 1e6)};
};

}  // namespace armature::janus
