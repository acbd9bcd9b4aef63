// SPDX-License-Identifier: Apache-2.0
// The check of gains beside the simulated arm: random gains of one joint after the other, in the
// poses where that joint is lightest and heaviest.
#include <chrono>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "armature/control/dynamics/computed_torque.hpp"
#include "armature/control/dynamics/joint_inertias.hpp"
#include "armature/control/low_pass.hpp"
#include "armature/control/sampled_loop.hpp"
#include "robots/wam/emulator/arm_simulation.hpp"
#include "robots/wam/joint_controller.hpp"
#include "tests/gains/trial.hpp"

namespace armature::wam {
namespace {

using namespace std::chrono_literals;
using control::InverseDynamics;
using control::JointRange;
using control::SampledController;
using Vector = std::vector<double>;

constexpr auto kCycle = 2ms;
constexpr auto kDelay = 1600us;  // within what the check takes for it, in steps of the simulation
constexpr double kDelayOfCheck = 0.0017;
constexpr int kCycles = 2000;
constexpr double kPush = 0.1;     // [rad/s]
constexpr double kCutoff = 1000;  // [rad/s]

std::string urdf(const ArmNumbers& arm) { return WAM "/" + std::string(arm.urdf); }

InverseDynamics load_links(const ArmNumbers& arm) {
  base::Diagnostics diagnostics;
  return std::move(
      *InverseDynamics::load(urdf(arm), {.gravity = {0.0, 0.0, -kGravity}}, diagnostics));
}

/// The arm as the check knows it, and as it is simulated.
class Trials {
 public:
  explicit Trials(const ArmNumbers& numbers)
      : arm(numbers),
        links(load_links(numbers)),
        rotors(control::Transmission::make(numbers.transmission).value()),
        ranges(control::find_joint_ranges(links, &rotors, control::search_limits(links))),
        weight(numbers.joints()),
        motors(numbers.joints()),
        positions(numbers.joints()) {}

  control::JointPlant plant(std::size_t joint, double inertia) const {
    const Vector none(arm.joints(), 0.0);
    Vector turning = none, torques = none;
    turning[joint] = 1.0;
    rotors.add_rotor_torques(turning, none, torques);
    return {.inertia = inertia, .damping = torques[joint], .delay_s = kDelayOfCheck};
  }
  bool accepts(std::size_t joint, const SampledController& light,
               const SampledController& heavy) const {
    const JointRange& range = ranges[joint];
    return control::has_margin(plant(joint, range.least_inertia), light, kPeriod) &&
           control::has_margin(plant(joint, range.most_inertia), heavy, kPeriod);
  }

  /// @param law  from positions to torques, with the weight
  template <typename Law>
  bool shakes(std::size_t joint, const Vector& pose, Law&& law) {
    auto simulated =
        ArmSimulation::load(arm, {.urdf_file = urdf(arm), .inner_step = 200us, .start = pose})
            .value();
    Vector push(arm.joints(), 0.0), torques(arm.joints());
    push[joint] = kPush;
    simulated.set_state(pose, push);
    gains::Shaking shaking(kCycles);
    for (int cycle = 0; cycle < kCycles; ++cycle) {
      for (std::size_t i = 0; i < arm.joints(); ++i) positions[i] = simulated.joint_position(i);
      law(positions, torques);
      simulated.advance(kDelay);
      rotors.motor_torques(torques, motors);
      for (std::size_t i = 0; i < arm.joints(); ++i) simulated.set_torque(i, motors[i]);
      if (simulated.advance(kCycle - kDelay) != sim::PlantStatus::kGood) return true;
      shaking.add(simulated.joint_velocity(joint));
    }
    return shaking.found();
  }
  template <typename Law>
  bool shakes_somewhere(std::size_t joint, const Law& law) {
    return shakes(joint, inside(ranges[joint].lightest_pose), law()) ||
           shakes(joint, inside(ranges[joint].heaviest_pose), law());
  }

  const ArmNumbers& arm;
  InverseDynamics links;
  control::Transmission rotors;
  std::vector<JointRange> ranges;
  Vector weight;
  Vector motors;
  Vector positions;

 private:
  /// Not at its stops, which would push it.
  Vector inside(Vector pose) const {
    for (std::size_t i = 0; i < pose.size(); ++i) {
      const control::JointLimits& limits = links.limits()[i];
      pose[i] = std::clamp(pose[i], limits.lower + 0.1, limits.upper - 0.1);
    }
    return pose;
  }
};

/// Decades about 1.
class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}
  double decades(double each_way) {
    return std::pow(10.0, std::uniform_real_distribution<double>(-each_way, each_way)(random_));
  }

 private:
  std::mt19937 random_;
};

class Gains : public ::testing::TestWithParam<int> {
 protected:
  const ArmNumbers& arm() const { return GetParam() == 4 ? wam4() : wam7(); }
};
INSTANTIATE_TEST_SUITE_P(Wam, Gains, ::testing::Values(4, 7));

TEST_P(Gains, WithWhichItIsHeldShakeNoJointIfTheyAreAccepted) {
  Trials trials(arm());
  gains::Tally::print_head();
  for (std::size_t joint = 0; joint < arm().joints(); ++joint) {
    Draw draw(static_cast<unsigned>(1000 + joint));
    gains::Tally tally;
    for (int set = 0; set < gains::sets(); ++set) {
      std::vector<JointGains> held = arm().gains;
      held[joint].kp *= draw.decades(1.5);
      held[joint].ki *= draw.decades(3.0);
      held[joint].kd *= draw.decades(1.5);
      const auto controller = SampledController::of(control::PositionalPid::Config{
          .kp = held[joint].kp, .ki = held[joint].ki, .kd = held[joint].kd, .period_s = kPeriod});
      gains::judge(tally, trials.accepts(joint, controller, controller), [&](double share) {
        std::vector<JointGains> some = held;
        some[joint].kp *= share;
        some[joint].ki *= share;
        some[joint].kd *= share;
        return trials.shakes_somewhere(joint, [&] {
          return [&trials, holder = JointController::make({.gains = some}).value(),
                  reference = Vector()](const Vector& at, Vector& torques) mutable {
            if (reference.empty()) reference = at;
            holder.step(reference, at, torques);
            trials.links.gravity(at, trials.weight);
            for (std::size_t i = 0; i < at.size(); ++i) torques[i] += trials.weight[i];
          };
        });
      });
    }
    const std::string what =
        "wam" + std::to_string(GetParam()) + " holding, joint " + std::to_string(joint + 1);
    tally.print(what);
    gains::expect_good(tally, what);
  }
}

/// As ControllerOfModel estimates velocities.
class ComputedTorque {
 public:
  ComputedTorque(const ArmNumbers& arm, const Vector& kp, const Vector& kd)
      : law_(control::ComputedTorque::make(load_links(arm),
                                           control::Transmission::make(arm.transmission).value(),
                                           {.kp = kp, .kd = kd})
                 .value()),
        filters_(arm.joints(),
                 control::LowPass::make({.omega = kCutoff, .period_s = kPeriod}).value()),
        motion_(2 * arm.joints()) {}

  void operator()(const Vector& at, Vector& torques) {
    const std::size_t count = at.size();
    const bool first = reference_.empty();
    if (first) {
      reference_ = at;
      reference_.resize(3 * count, 0.0);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const double moved = first ? 0.0 : at[i] - motion_[i];
      motion_[i] = at[i];
      motion_[count + i] = filters_[i].step(moved / kPeriod);
    }
    law_.step(reference_, motion_, torques);
  }

 private:
  control::ComputedTorque law_;
  std::vector<control::LowPass> filters_;
  Vector motion_;
  Vector reference_;
};

TEST_P(Gains, OfComputedTorqueShakeNoJointIfTheyAreAccepted) {
  Trials trials(arm());
  gains::Tally::print_head();
  for (std::size_t joint = 0; joint < arm().joints(); ++joint) {
    Draw draw(static_cast<unsigned>(2000 + joint));
    gains::Tally tally;
    for (int set = 0; set < gains::sets(); ++set) {
      Vector kp(arm().joints(), 1600.0), kd(arm().joints(), 80.0);
      kp[joint] *= draw.decades(2.0);
      kd[joint] *= draw.decades(1.5);
      const auto law = [&](double inertia) {
        return SampledController::of(SampledController::FilteredPd{
            kp[joint] * inertia, kd[joint] * inertia, kCutoff, kPeriod});
      };
      const bool accepted = trials.accepts(joint, law(trials.ranges[joint].least_inertia),
                                           law(trials.ranges[joint].most_inertia));
      gains::judge(tally, accepted, [&](double share) {
        Vector some_kp = kp, some_kd = kd;
        some_kp[joint] *= share;
        some_kd[joint] *= share;
        return trials.shakes_somewhere(joint,
                                       [&] { return ComputedTorque(arm(), some_kp, some_kd); });
      });
    }
    const std::string what =
        "wam" + std::to_string(GetParam()) + " computed, joint " + std::to_string(joint + 1);
    tally.print(what);
    gains::expect_good(tally, what);
  }
}

}  // namespace
}  // namespace armature::wam
