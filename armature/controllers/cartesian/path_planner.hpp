// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/component/author.hpp"
#include "armature/control/cartesian/cartesian_plan.hpp"
#include "armature/control/cartesian/inverse_kinematics.hpp"
#include "armature/controllers/base/held_jog.hpp"
#include "armature/controllers/base/max_age.hpp"

namespace armature::controllers {

/// Moves a robot's tool on lines, arcs and paths with rounded corners: it plans them, and has the
/// generator, an nAxesGeneratorTaught among its peers, play what it has planned
/// (control::plan_cartesian). The whole path is tried out before anything moves: one that is out of
/// reach, leaves the limits of a joint or passes where the arm is singular is refused, with the
/// place. It begins only where the joints rest. It arms nothing; the generator refuses while the
/// robot is not armed or another motion is under way, keeps the joints' limits, and brakes on the
/// path when it is stopped or cancelled.
///
/// A pose is x, y, z [m], roll, pitch, yaw [rad] (as URDF has them) of `tip_link` in the axes of
/// `base_link`. A speed [m/s] of 0 is max_tool_velocity.
///
/// `jog(axis, velocity)` moves the tool along or about an axis of the base or of the tool as long
/// as `keepJogging` with the same numbers renews it: 150 ms after the last renewal the generator
/// brakes, whatever happens to this component. The line is planned when the jog begins, as far as
/// the joints get: it ends, smoothly, before a joint's limit, the end of the reach, or a place
/// where the arm is singular; `jog_end` says which.
///
/// The robot needs six joints or more. Planning takes tens of milliseconds: its thread is to be one
/// of its own without real time, `activity: {periodic: 10 ms, scheduler: other}`, of at most 20 ms.
class PathPlanner final : public component::Component {
 public:
  using Component::Component;

 private:
  using Vector = std::vector<double>;
  using Path = base::Result<control::PosePath>;
  using Caller = component::CommandCaller<const Vector&, double>;

  void on_check(component::Check& check) const override;
  component::Outcome on_configure() override;
  component::Outcome on_start() override;
  void on_stop() override;
  void on_update() override;

  component::Outcome begin_line(const Vector& pose, double speed);
  component::Outcome begin_arc(const Vector& via, const Vector& pose, double speed);
  component::Outcome begin_path(const Vector& poses, double blend, double speed);
  component::Outcome begin_jog(int axis, double velocity);
  bool keep_jogging(int axis, double velocity);
  void cancel() { motion_.cancel(); }
  Vector pose();

  base::Result<Vector> begin_at_rest();
  bool has_left(const Vector& begin);
  component::Outcome play(const Vector& begin, const Path& path, double speed);
  component::Outcome send(Caller& caller, const Vector& begin, const control::CartesianPlan& plan);
  std::string objection_to_limits();
  template <typename Command>
  void follow(Command& command);

  component::Property<int> joints_{
      this, "joints", 6, "number of joints", "", component::mandatory, component::range(1, 100000)};
  component::Property<std::string> file_{
      this, "robot_description",
      "",   "the robot's description (URDF), a file; a path counts from the working directory",
      "",   component::mandatory};
  component::Property<std::string> base_link_{this, "base_link", "",
                                              "the link in whose axes poses are; empty: the root"};
  component::Property<std::string> tip_link_{
      this, "tip_link", "",
      "the link that is moved, such as the tool; empty: that of the last joint"};
  component::Property<Vector> lower_{
      this, "lower", {}, "of each joint; none: the description's", "rad"};
  component::Property<Vector> upper_{
      this, "upper", {}, "of each joint; none: the description's", "rad"};
  component::Property<double> velocity_{this,  "max_tool_velocity",          0.25, "of the tool",
                                        "m/s", component::range(1e-4, 100.0)};
  component::Property<double> acceleration_{this,    "max_tool_acceleration",
                                            1.0,     "of the tool; of its turn 10 rad/s^2 for each",
                                            "m/s^2", component::range(1e-3, 1000.0)};
  component::Property<double> turning_{this,    "max_tool_turning",           1.0, "of the tool",
                                       "rad/s", component::range(1e-3, 100.0)};
  component::Property<double> deviation_{
      this,  "max_deviation",
      0.001, "of the tool from its path, and 5 rad of turn for each m",
      "m",   component::range(1e-6, 0.1)};
  component::InputPort<Vector> desired_{this,
                                        "nAxesDesiredPosition",
                                        "where the generator has the joints",
                                        "rad",
                                        component::size_of(joints_),
                                        component::max_age(kMaxAge, component::Reaction::kHold),
                                        component::on_lost(component::Reaction::kHold)};
  component::InputPort<Vector> desired_velocity_{
      this,
      "nAxesDesiredVelocity",
      "how fast the generator moves the joints",
      "rad/s",
      component::size_of(joints_),
      component::max_age(kMaxAge, component::Reaction::kHold),
      component::on_lost(component::Reaction::kHold)};
  component::Property<std::string> jog_frame_{this,   "jog_frame",
                                              "base", "in whose axes jog moves: base or tool",
                                              "",     component::changeable_while_running};
  component::Attribute<component::Reason> jog_end_{
      this, "jog_end", {}, "what ends the last jog, if it is held on to"};
  Caller play_path_{this, "playFromHere", "plays a path"};
  Caller jog_path_{this, "jogPath", "plays a path as long as it is renewed"};
  component::OperationCaller<bool()> keep_jogging_path_{this, "keepJoggingPath", "renews it"};
  component::Command<const Vector&, double> line_{
      this,
      "moveLinear",
      component::serve<&PathPlanner::begin_line>,
      "moves the tool on a line",
      component::args("pose [x y z roll pitch yaw]", "speed [m/s]"),
      component::cancelled_by<&PathPlanner::cancel>};
  component::Command<const Vector&, const Vector&, double> arc_{
      this,
      "moveArc",
      component::serve<&PathPlanner::begin_arc>,
      "moves the tool on the arc through a place",
      component::args("via [x y z]", "pose [x y z roll pitch yaw]", "speed [m/s]"),
      component::cancelled_by<&PathPlanner::cancel>};
  component::Command<const Vector&, double, double> path_{
      this,
      "movePath",
      component::serve<&PathPlanner::begin_path>,
      "moves the tool on lines through poses, whose corners are rounded",
      component::args("poses [x y z roll pitch yaw, of each]", "blend [m]", "speed [m/s]"),
      component::cancelled_by<&PathPlanner::cancel>};
  component::Command<int, double> jog_{
      this,
      "jog",
      component::serve<&PathPlanner::begin_jog>,
      "moves the tool along (1 to 3) or about (4 to 6) x, y, z as long as keepJogging renews it",
      component::args("axis (from 1)", "velocity [m/s or rad/s]"),
      component::cancelled_by<&PathPlanner::cancel>};
  component::Operation<bool(int, double)> keep_jogging_{
      this,
      "keepJogging",
      component::serve<&PathPlanner::keep_jogging>,
      "renews the jog of the same numbers; false: it is not under way, or brakes",
      component::args("axis (from 1)", "velocity [m/s or rad/s]"),
      component::in_own_thread};
  component::Operation<Vector()> tool_{this, "pose", component::serve<&PathPlanner::pose>,
                                       "where the generator has the tool: x y z roll pitch yaw",
                                       component::in_own_thread};

  std::optional<control::InverseKinematics> arm_;
  control::CartesianLimits limits_;
  component::CommandHandle motion_{component::CallStatus::kNotConnected};  ///< sent last
  HeldJog jogging_;
};

}  // namespace armature::controllers
