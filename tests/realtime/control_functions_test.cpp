// SPDX-License-Identifier: Apache-2.0
// The real-time functions of control.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "armature/control/absolute_position.hpp"
#include "armature/control/arming/gathering.hpp"
#include "armature/control/arming/hand_over.hpp"
#include "armature/control/arming/reference_brake.hpp"
#include "armature/control/dc_motor.hpp"
#include "armature/control/dynamics/computed_torque.hpp"
#include "armature/control/dynamics/forward_kinematics.hpp"
#include "armature/control/dynamics/gravity_pd.hpp"
#include "armature/control/dynamics/inverse_dynamics.hpp"
#include "armature/control/dynamics/quaternion.hpp"
#include "armature/control/error_metrics.hpp"
#include "armature/control/following_watch.hpp"
#include "armature/control/joint_limiter.hpp"
#include "armature/control/low_pass.hpp"
#include "armature/control/pid.hpp"
#include "armature/control/polynomial.hpp"
#include "armature/control/positional_pid.hpp"
#include "armature/control/sampled_loop.hpp"
#include "armature/control/still_watch.hpp"
#include "armature/control/trajectory.hpp"
#include "armature/control/transmission.hpp"
#include "armature/control/trapezoid.hpp"
#include "tests/realtime/expect_realtime.hpp"

namespace armature {
namespace {

using namespace std::chrono_literals;

TEST(RealtimeFunctions, Pid) {
  auto pid = control::Pid::make({.kp = 1.0, .ki = 0.1, .kd = 0.1, .u_min = -5.0, .u_max = 5.0});
  double output = 0.0;
  expect_realtime("Pid::step", [&] { output = pid.value().step(0.1); });
  EXPECT_GT(output, 0.0);
  expect_realtime("Pid::reset_to", [&] { pid.value().reset_to(2.0); });
  EXPECT_EQ(pid.value().state().output, 2.0);
  expect_realtime("Pid::reset", [&] { pid.value().reset(); });
  EXPECT_EQ(pid.value().state().output, 0.0);
}

TEST(RealtimeFunctions, HandOver) {
  control::HandOver over(3);
  const std::vector<double> present{1.0, 2.0, 3.0};
  std::vector<double> signals(3, 0.0);
  base::Time now{};
  expect_realtime("HandOver::begin", [&] { over.begin(present); });
  double most = 0.0;
  expect_realtime("HandOver::step", [&] {
    signals.assign(3, 0.0);
    over.step(signals, now += 10ms, 1s);
    most = std::max(most, signals[2]);
  });
  EXPECT_EQ(most, 3.0);
  expect_realtime("HandOver::reset", [&] { over.reset(); });
  EXPECT_FALSE(over.active());
}

TEST(RealtimeFunctions, Trapezoid) {
  const auto motion = control::Trapezoid::rest_to_rest(0.0, 1.0, 2.0, 0.25);
  double time_s = 0.0;
  control::MotionSample sample;
  expect_realtime("Trapezoid::at", [&] { sample = motion.at(time_s += 0.1); });
  EXPECT_EQ(sample.position, 1.0);
}

TEST(RealtimeFunctions, Trajectory) {
  const control::Trajectory::Axis axis{.max_velocity = 1.0, .max_acceleration = 5.0};
  auto made = control::Trajectory::make({std::vector(7, axis)});
  auto& trajectory = made.value();
  const std::vector<double> start(7, 0.0);
  const std::vector<double> target(7, 1.0);
  bool accepted = true;
  std::string_view text;
  expect_realtime("Trajectory::hold",
                  [&] { accepted = accepted && trajectory.hold(start).accepted(); });
  expect_realtime("Trajectory::check_request",
                  [&] { accepted = accepted && trajectory.check_request(target, 1.0).accepted(); });
  expect_realtime("Trajectory::move_to", [&] {
    accepted = accepted && trajectory.hold(start).accepted();
    accepted = accepted && trajectory.move_to(target, 2.0).accepted();
    text = control::to_text(trajectory.move_to(target, 2.0).refusal);
  });
  expect_realtime("control::to_text",
                  [&] { text = control::to_text(trajectory.move_to(target, 2.0).refusal); });
  EXPECT_EQ(text, "a motion is under way");
  expect_realtime("Trajectory::step", [&] { trajectory.step(10ms); });
  EXPECT_GT(trajectory.velocities()[6], 0.0);
  double position = 0.0;
  expect_realtime("Trajectory::sample", [&] { position = trajectory.sample(6, 2.0).position; });
  EXPECT_EQ(position, 1.0);
  expect_realtime("Trajectory::stop", [&] { trajectory.stop(); });
  EXPECT_LT(trajectory.accelerations()[6], 0.0);
  expect_realtime("Trajectory::stop_from",
                  [&] { accepted = accepted && trajectory.stop_from(start, target).accepted(); });
  const control::Trajectory::Axis limited{1.0, 5.0, -9.0, 9.0};
  auto jogging = control::Trajectory::make({std::vector(7, limited)}).value();
  expect_realtime("Trajectory::jog", [&] {
    accepted = accepted && jogging.hold(start).accepted();
    accepted = accepted && jogging.jog(6, 0.5).accepted();
  });
  EXPECT_TRUE(accepted);
}

/// Allows the first axis half of the velocity that its motor has.
class Slow final : public control::MotionLimit {
 public:
  double used(std::span<const double>, std::span<const double> velocities) override {
    return velocities[0] / 0.5;
  }
};

TEST(RealtimeFunctions, TrajectoryWithALimitOfItsOwn) {
  const control::Trajectory::Axis axis{.max_velocity = 1.0, .max_acceleration = 5.0};
  auto trajectory = control::Trajectory::make({std::vector(7, axis)}).value();
  const std::vector<double> start(7, 0.0);
  const std::vector<double> target(7, 1.0);
  Slow slow;
  control::Trajectory::Answer answer;
  expect_realtime("MotionLimit::used", [&] {
    static_cast<void>(trajectory.hold(start));
    answer = trajectory.move_to(target, 1.5, &slow);
  });
  EXPECT_EQ(answer.refusal, control::Refusal::kTooFast);
  EXPECT_GT(answer.shortest_s, 2.0);
}

TEST(RealtimeFunctions, JointLimiter) {
  auto made = control::JointLimiter::make({.lower = -1.0,
                                           .upper = 1.0,
                                           .max_velocity = 1.0,
                                           .max_acceleration = 5.0,
                                           .max_effort = 12.0,
                                           .period = 10ms,
                                           .arming_time = 1s,
                                           .effort_rate = 12.0});
  auto& limiter = made.value();
  control::JointLimiter::Step<control::LimitedVelocity> velocity;
  control::JointLimiter::Step<control::LimitedPosition> position;
  control::JointLimiter::LimitedStep driven;
  expect_realtime("JointLimiter::arm", [&] { limiter.arm({0.0, 0.0}); });
  expect_realtime("JointLimiter::step_effort", [&] {
    driven = limiter.step_effort({0.0, 0.0}, 20.0);
  });
  EXPECT_EQ(driven.value, 12.0);
  expect_realtime("JointLimiter::end_rate_limit", [&] {
    limiter.arm({0.0, 0.0});
    limiter.end_rate_limit();
    driven = limiter.step_effort({0.0, 0.0}, 10.0);
  });
  EXPECT_EQ(driven.value, 10.0) << "at once";
  expect_realtime("JointLimiter::step_velocity", [&] {
    velocity = limiter.step_velocity({0.0, 0.0}, 20.0);
  });
  EXPECT_EQ(velocity.value, 1.0);
  expect_realtime("JointLimiter::step_position", [&] {
    position = limiter.step_position({0.0, 0.0}, 20.0);
  });
  EXPECT_GT(position.value, 0.5);
  expect_realtime("JointLimiter::disarm", [&] { limiter.disarm(); });
  EXPECT_FALSE(limiter.armed());
}

TEST(RealtimeFunctions, AbsolutePosition) {
  auto made = control::AbsolutePosition::make({.range = 6.0, .max_velocity = 1.0});
  auto& position = made.value();
  double sensor = 0.0;
  control::AbsolutePosition::Reading reading;
  expect_realtime("AbsolutePosition::reset", [&] { position.reset(); });
  expect_realtime("AbsolutePosition::step", [&] { reading = position.step(sensor += 0.1, 0.1); });
  EXPECT_NEAR(reading.position, 10.1, 1e-9);
  expect_realtime("AbsolutePosition::at", [&] { sensor = position.at(1.0); });
  EXPECT_NEAR(sensor, 1.0, 1e-9);
}

TEST(RealtimeFunctions, FollowingWatch) {
  control::FollowingWatch watch({.max_error = 0.1, .patience = 0ms});
  bool follows = true;
  expect_realtime("FollowingWatch::step", [&] { follows = watch.step(0.2, base::Time{}); });
  EXPECT_FALSE(follows);
  expect_realtime("FollowingWatch::reset", [&] { watch.reset(); });
}

TEST(RealtimeFunctions, StillWatch) {
  control::StillWatch watch({.most = 0.1});
  bool moves = true;
  expect_realtime("StillWatch::step", [&] { moves = watch.step(0.5, 0.02, 0.01); });
  EXPECT_FALSE(moves);
  expect_realtime("StillWatch::reset", [&] { watch.reset(); });
  EXPECT_TRUE(watch.step(0.5, 0.02, 0.01));
}

TEST(RealtimeFunctions, ErrorMetrics) {
  auto metrics = control::ErrorMetrics::make({2, 10ms});
  expect_realtime("ErrorMetrics::step", [&] { metrics.value().step(std::array{0.1, -0.1}); });
  EXPECT_EQ(metrics.value().samples(), 101u);
  expect_realtime("ErrorMetrics::reset", [&] { metrics.value().reset(); });
  EXPECT_EQ(metrics.value().samples(), 0u);
}

TEST(RealtimeFunctions, Gathering) {
  auto made = control::Gathering::make({.members = 3, .values_each = 2});
  auto& gathering = made.value();
  control::Gathering::Round round;
  bool complete = false;
  expect_realtime("Gathering::begin", [&] { round = gathering.begin(); });
  EXPECT_EQ(round.overdue, 0u);
  expect_realtime("Gathering::add", [&] {
    gathering.begin();
    for (const std::size_t member : {0u, 1u, 2u}) {
      complete = gathering.add(member, 1.0);
      complete = gathering.add(member, 2.0, 1);
    }
  });
  EXPECT_TRUE(complete);
  expect_realtime("Gathering::reset", [&] { gathering.reset(); });
  EXPECT_EQ(gathering.values()[5], 0.0);
}

TEST(RealtimeFunctions, ReferenceBrake) {
  auto made =
      control::ReferenceBrake::make({.joints = 2, .max_acceleration = {1.0}, .period = 10ms});
  auto& brake = made.value();
  const std::vector<double> last{1.0, 2.0, 0.5, 0.0, 0.0, 0.0};
  const std::vector<double> measured{1.0, 2.0, 0.0, 0.0};
  expect_realtime("ReferenceBrake::begin", [&] { brake.begin(last); });
  bool near = false;
  expect_realtime("ReferenceBrake::rests_near", [&] { near = brake.rests_near(last, 0.1); });
  EXPECT_TRUE(near);
  expect_realtime("ReferenceBrake::step", [&] { brake.step(); });
  EXPECT_EQ(brake.step()[2], 0.0);
  bool may = true;
  expect_realtime("ReferenceBrake::may_give_way_to",
                  [&] { may = brake.may_give_way_to(last, measured); });
  EXPECT_FALSE(may) << "it moves";
}

constexpr const char* kPendulum =
    "<robot name='r'><link name='base'/><link name='rod'><inertial><mass value='1'/><inertia "
    "ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link><joint name='j' "
    "type='continuous'><parent link='base'/><child link='rod'/><axis xyz='0 1 0'/></joint>"
    "</robot>";

control::InverseDynamics pendulum() {
  base::Diagnostics diagnostics;
  auto model = control::InverseDynamics::parse(kPendulum, "r.urdf", {}, diagnostics);
  EXPECT_TRUE(model) << diagnostics.to_text();
  return std::move(model.value());
}

control::Transmission gear() {
  return control::Transmission::make({.turns = {2.0}, .rotor_inertia = {0.5}}).value();
}

TEST(RealtimeFunctions, InverseDynamics) {
  auto model = pendulum();
  const std::array<double, 3> motion{0.1, 0.2, 3.0};
  std::array<double, 1> result{};
  expect_realtime("InverseDynamics::step", [&] { model.step(motion, result); });
  EXPECT_NEAR(result[0], 3.0, 1e-12);
  const std::array<double, 1> position{0.1};
  expect_realtime("InverseDynamics::gravity", [&] { model.gravity(position, result); });
  EXPECT_NEAR(result[0], 0.0, 1e-12);
  expect_realtime("InverseDynamics::mass_matrix", [&] { model.mass_matrix(position, result); });
  EXPECT_NEAR(result[0], 1.0, 1e-12);
}

TEST(RealtimeFunctions, ForwardKinematics) {
  base::Diagnostics diagnostics;
  auto model = control::ForwardKinematics::parse(kPendulum, "r.urdf", {}, diagnostics);
  ASSERT_TRUE(model) << diagnostics.to_text();
  const std::array<double, 1> position{0.1};
  control::Pose pose;
  expect_realtime("ForwardKinematics::step", [&] { model->step(position, pose); });
  EXPECT_NEAR(pose.rotation[0], std::cos(0.1), 1e-12);
}

TEST(RealtimeFunctions, QuaternionOf) {
  const std::array<double, 9> half_a_turn_about_z{-1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 1.0};
  std::array<double, 4> quaternion{};
  expect_realtime("control::quaternion_of",
                  [&] { quaternion = control::quaternion_of(half_a_turn_about_z); });
  EXPECT_NEAR(std::abs(quaternion[2]), 1.0, 1e-12);
}

TEST(RealtimeFunctions, Transmission) {
  const auto transmission = gear();
  const std::array<double, 1> from{3.0};
  std::array<double, 1> to{};
  expect_realtime("Transmission::motor_angles", [&] { transmission.motor_angles(from, to); });
  EXPECT_EQ(to[0], 6.0);
  expect_realtime("Transmission::joint_angles", [&] { transmission.joint_angles(from, to); });
  EXPECT_EQ(to[0], 1.5);
  expect_realtime("Transmission::motor_torques", [&] { transmission.motor_torques(from, to); });
  EXPECT_EQ(to[0], 1.5);
  expect_realtime("Transmission::joint_torques", [&] { transmission.joint_torques(from, to); });
  EXPECT_EQ(to[0], 6.0);
  expect_realtime("Transmission::add_rotor_torques", [&] {
    to = {};
    transmission.add_rotor_torques(from, from, to);
  });
  EXPECT_EQ(to[0], 6.0);
}

TEST(RealtimeFunctions, ControllersByAModel) {
  auto computed = control::ComputedTorque::make(pendulum(), gear(), {.kp = {1.0}, .kd = {1.0}});
  auto gravity = control::GravityPd::make(pendulum(), {.kp = {1.0}, .kd = {1.0}});
  const std::array<double, 3> reference{0.1, 0.0, 1.0};
  const std::array<double, 2> measured{0.1, 0.0};
  std::array<double, 1> torque{};
  expect_realtime("ComputedTorque::step",
                  [&] { computed.value().step(reference, measured, torque); });
  EXPECT_NEAR(torque[0], 3.0, 1e-12);
  expect_realtime("GravityPd::step", [&] { gravity.value().step(reference, measured, torque); });
  EXPECT_NEAR(torque[0], 0.0, 1e-12);
}

TEST(RealtimeFunctions, PositionalPid) {
  auto pid = control::PositionalPid::make({.kp = 2.0, .period_s = 0.01}).value();
  double output = 0.0;
  expect_realtime("PositionalPid::step", [&] { output = pid.step(1.5); });
  EXPECT_EQ(output, 3.0);
  expect_realtime("PositionalPid::reset", [&] { pid.reset(); });
  expect_realtime("PositionalPid::reset_to", [&] { pid.reset_to(0.5); });
  EXPECT_EQ(pid.state().last_error, 0.5);
}

TEST(RealtimeFunctions, LowPass) {
  auto filter = control::LowPass::make({.omega = 1.0, .period_s = 1.0}).value();
  double output = 0.0;
  expect_realtime("LowPass::reset_to", [&] { filter.reset_to(1.0); });
  expect_realtime("LowPass::step", [&] { output = filter.step(1.0); });
  EXPECT_EQ(output, 1.0);
}

TEST(RealtimeFunctions, RootsOfAPolynomial) {
  const control::Polynomial polynomial{-6.0, 11.0, -6.0, 1.0};
  control::Polynomial::Roots roots;
  std::size_t count = 0;
  expect_realtime("Polynomial::find_roots", [&] { count = polynomial.find_roots(roots); });
  EXPECT_EQ(count, 3u);
}

TEST(RealtimeFunctions, SampledLoop) {
  constexpr double kPeriod = 0.002;
  const control::JointPlant plant{.inertia = 0.3, .delay_s = 0.001};
  const auto gains = control::SampledController::FilteredPd{
      .kp = 30.0, .kd = 6.0, .cutoff = 300.0, .period_s = kPeriod};
  const auto controller = control::SampledController::of(gains);
  control::LoopStability loop;
  expect_realtime("control::judge_loop",
                  [&] { loop = control::judge_loop(plant, controller, kPeriod); });
  EXPECT_TRUE(loop.finite);
  EXPECT_GT(loop.gain_margin, 1.0);
  bool margin = false;
  expect_realtime("control::has_margin",
                  [&] { margin = control::has_margin(plant, controller, kPeriod); });
  EXPECT_EQ(margin, loop.has_margin());
}

TEST(RealtimeFunctions, DcMotor) {
  const auto made = control::DcMotor::make(
      {.resistance_ohm = 2.0, .torque_constant = 0.035, .gear_ratio = 100.0});
  const auto& motor = made.value();
  double value = 0.0;
  expect_realtime("DcMotor::voltage", [&] { value = motor.voltage(1.0, 0.0); });
  expect_realtime("DcMotor::torque", [&] { value = motor.torque(value, 0.0); });
  expect_realtime("DcMotor::current", [&] { value = motor.current(2.0, 0.0); });
  EXPECT_EQ(value, 1.0);
  expect_realtime("DcMotor::friction", [&] { value = motor.friction(1.0); });
  expect_realtime("DcMotor::reflected_inertia", [&] { value = motor.reflected_inertia(); });
  EXPECT_EQ(value, 0.0);
}

}  // namespace
}  // namespace armature
