// SPDX-License-Identifier: Apache-2.0
// The check of gains beside the simulated head: random gains of the PID of each joint.
#include <chrono>
#include <cmath>
#include <random>
#include <string>

#include "armature/control/dynamics/joint_inertias.hpp"
#include "armature/control/pid.hpp"
#include "armature/control/sampled_loop.hpp"
#include "robots/janus/head.hpp"
#include "tests/gains/trial.hpp"

namespace armature::janus {
namespace {

using namespace std::chrono_literals;
using control::Pid;
using control::SampledController;

constexpr auto kPeriod = 10ms;
constexpr double kPeriodInSeconds = 0.01;
constexpr auto kDelay = 700us;
constexpr int kCycles = 600;
constexpr const char* kUrdf = JANUS "/janus.urdf";

Pid::Config some(const Pid::Config& gains, double share) {
  return {gains.kp * share, gains.ki * share, gains.kd * share, gains.u_min, gains.u_max};
}

/// The joint with its controller, whose reference steps: smaller pushes are lost in friction.
bool shakes(std::size_t joint, const Pid::Config& gains) {
  constexpr double kReference = 0.3;
  constexpr double kStep = 0.02;
  auto head =
      Head::load({.urdf_file = kUrdf, .initial_position = {kReference, kReference}}).value();
  for (std::size_t i = 0; i < kJoints; ++i) head->wiring(i).release_brake({});
  Pid pid = Pid::make(gains).value();
  gains::Shaking shaking(kCycles);
  for (int cycle = 0; cycle < kCycles; ++cycle) {
    const base::Time now = base::Time{} + cycle * kPeriod;
    const double reference = cycle < 20 ? kReference : kReference + kStep;
    const double effort = pid.step(reference - head->position(joint, now));
    head->wiring(joint).drive(effort / kSupplyVoltage, now + kDelay);
    for (auto inner = kDelay; inner < kPeriod; inner += 1ms) {
      head->advance_to(now + inner);
    }
    shaking.add(head->velocity(joint, now + kPeriod));
  }
  return shaking.found();
}

control::JointPlant plant_with(double inertia) {
  constexpr double kPerVolt = kMotor.torque_constant * kMotor.gear_ratio / kMotor.resistance_ohm;
  return {
      .inertia = inertia + kMotor.rotor_inertia * kMotor.gear_ratio * kMotor.gear_ratio,
      .damping = kMotor.viscous_friction + kPerVolt * kMotor.torque_constant * kMotor.gear_ratio,
      .torque_per_effort = kPerVolt,
      .delay_s = 0.0007};
}

TEST(Gains, OfAPidShakeNoJointOfTheHeadIfTheyAreAccepted) {
  base::Diagnostics diagnostics;
  auto links = control::InverseDynamics::load(kUrdf, {}, diagnostics);
  const auto ranges = control::find_joint_ranges(*links, nullptr, control::search_limits(*links));
  gains::Tally::print_head();
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
    std::mt19937 random(static_cast<unsigned>(3000 + joint));
    const auto decades = [&](double each_way) {
      return std::pow(10.0, std::uniform_real_distribution<double>(-each_way, each_way)(random));
    };
    gains::Tally tally;
    for (int set = 0; set < gains::sets(); ++set) {
      const Pid::Config gains{.kp = 400.0 * decades(1.0),
                              .ki = 20.0 * decades(1.5),
                              .kd = 200.0 * decades(1.5),
                              .u_min = -12.0,
                              .u_max = 12.0};
      const auto controller = SampledController::of(gains);
      const bool accepted =
          control::has_margin(plant_with(ranges[joint].least_inertia), controller,
                              kPeriodInSeconds) &&
          control::has_margin(plant_with(ranges[joint].most_inertia), controller, kPeriodInSeconds);
      gains::judge(tally, accepted,
                   [&](double share) { return shakes(joint, some(gains, share)); });
    }
    const std::string what = "janus PID, joint " + std::to_string(joint + 1);
    tally.print(what);
    gains::expect_good(tally, what);
  }
}

}  // namespace
}  // namespace armature::janus
