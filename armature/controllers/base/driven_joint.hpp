// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/control/joint_limits.hpp"
#include "armature/control/sampled_loop.hpp"
#include "armature/controllers/base/joint_command.hpp"

namespace armature::controllers {

/// Who holds the weight of a joint, as its hardware has it.
enum class HoldsWeight : std::uint8_t {
  kAnybody,   ///< nobody says: whoever controls it may hold it, by its gains too
  kHardware,  ///< beside the commands
  kCommands,  ///< the hardware counts on commands that have it, and takes it off them
};

/// A joint as whoever controls it has to know it: the robot with its drives, not what it is told.
/// Efforts are in the unit of the commands for it, such as V.
struct DrivenJoint {
  std::string name{};               ///< for diagnostics, such as `joint 3 of WAM`
  control::JointPlant lightest{};   ///< with the smallest inertia of all poses
  control::JointPlant heaviest{};   ///< with the largest
  double most_effort = 0.0;         ///< that its limiter passes, > 0
  double most_weight = 0.0;         ///< [N m] to be held, in any pose
  std::array<double, 3> gravity{};  ///< [m/s^2] in the axes of its base
  HoldsWeight holds_weight = HoldsWeight::kAnybody;
  std::string unit = "rad";  ///< of its position; m of a linear axis
  // What its limiter lets through, in its unit and seconds; unlimited if nobody says.
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  double max_velocity = std::numeric_limits<double>::infinity();
  double max_acceleration = std::numeric_limits<double>::infinity();
  double motor_turns = 0.0;  ///< of its motor for one of the joint; 0: nobody says
};

/// Something that efforts go through, on their way to joints.
class DrivesJoints {
 public:
  /// The joints that are driven by what comes in, in their order.
  /// @param input  of this component; nullptr: an operation of it
  /// @return nothing if nobody says what the joints are
  /// @thread configuration only
  virtual std::vector<DrivenJoint> joints_behind(const component::InputPortBase* input,
                                                 const component::Check& check) = 0;

 protected:
  ~DrivesJoints() = default;
};

/// Something that computes the torques of a robot's motion from a model of it.
class ComputesTorques {
 public:
  /// [m/s^2] in the axes of the robot's base; 0: the weight is left to others
  virtual const std::array<double, 3>& gravity() const = 0;

 protected:
  ~ComputesTorques() = default;
};

/// Something that knows links and drives of a whole robot.
class DescribesRobot {
 public:
  /// One joint, behind its drive; an error says what is missing or wrong.
  /// @param number   from 1
  /// @param command  by which the joint is driven; of velocities and positions: the joint behind
  ///                 torques, as a drive that follows them has it
  /// @thread configuration only; the first one takes milliseconds
  virtual base::Result<DrivenJoint> joint(std::size_t number, JointCommand command) const = 0;
  /// What the description says of it; unlimited without one.
  virtual control::JointLimits limits(std::size_t number) const = 0;

 protected:
  ~DescribesRobot() = default;
};

/// Something that samples go through, on their way from joints to who controls them.
class PassesSamples {
 public:
  /// What `output` is made of.
  /// @thread configuration only
  virtual std::vector<const component::InputPortBase*> samples_behind(
      const component::OutputPortBase& output) const = 0;

 protected:
  ~PassesSamples() = default;
};

/// Something that controls one joint, by what is measured of it.
class ControlsJoint {
 public:
  virtual const component::InputPortBase& desired_input() const = 0;
  virtual const component::InputPortBase& measured_input() const = 0;

 protected:
  ~ControlsJoint() = default;
};

/// How many cycles late samples come by `input`, by connections that are declared so.
/// @thread configuration only
int cycles_late(const component::InputPortBase& input, const component::Check& check);

/// As who answers samples that come later knows them.
/// @param period_s  >= 0
void answer_later(std::vector<DrivenJoint>& joints, int cycles, double period_s);

/// The joints that an output drives, through whatever reads it, also a cycle later.
/// @thread configuration only
const std::vector<DrivenJoint>& joints_behind(const component::OutputPortBase& output,
                                              const component::Check& check);

/// What is wrong with the gains of a joint, with its figures; empty if its loop has a margin with
/// the lightest and with the heaviest plant.
/// @param on_light, on_heavy  the controller, which may compute with the inertia
/// @param period_s            > 0
std::string objection_to_gains(const DrivenJoint& joint, const control::SampledController& on_light,
                               const control::SampledController& on_heavy, double period_s);
std::string objection_to_gains(const DrivenJoint& joint,
                               const control::SampledController& controller, double period_s);

/// What is wrong with how a controller holds a joint's weight, as the joint's hardware knows it.
/// @param gravity  of its model [m/s^2], 0 if it leaves the weight to others; nothing: it has none
std::string objection_to_gravity(const DrivenJoint& joint,
                                 const std::optional<std::array<double, 3>>& gravity);

/// `1234.5` as it reads best.
std::string figure(double number);

}  // namespace armature::controllers
