// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/base/driven_joint.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "armature/base/seconds.hpp"

namespace armature::controllers {

using control::JointPlant;
using control::SampledController;

namespace {

/// [m/s^2] by which two numbers for the same gravity may differ.
constexpr double kSameGravity = 0.3;
/// [N m] Less than that is no weight that somebody has to hold: of an upright axis, rounding.
constexpr double kNoWeight = 1e-3;

double size_of(const std::array<double, 3>& vector) {
  return std::hypot(vector[0], vector[1], vector[2]);
}

std::string text_of(const std::array<double, 3>& vector) {
  return "[" + figure(vector[0]) + ", " + figure(vector[1]) + ", " + figure(vector[2]) + "] m/s^2";
}

struct CyclesLate {
  int count = 0;
};

CyclesLate count_cycles_late(const component::InputPortBase& input, const component::Check& check) {
  int most = 0;
  for (const component::OutputPortBase* const writer : check.writers_of(input)) {
    int late = 0;
    const auto* const passes = dynamic_cast<const PassesSamples*>(&writer->owner());
    if (passes != nullptr) {
      for (const component::InputPortBase* const behind : passes->samples_behind(*writer)) {
        late = std::max(late, cycles_late(*behind, check));
      }
    }
    most = std::max(most, late + (check.delayed(*writer, input) ? 1 : 0));
  }
  return {most};
}

std::vector<DrivenJoint> find_joints_behind(const component::OutputPortBase& output,
                                            const component::Check& check) {
  std::vector<DrivenJoint> all;
  for (const component::InputPortBase* const input : check.readers_of(output)) {
    auto* const reader = dynamic_cast<DrivesJoints*>(&input->owner());
    if (reader == nullptr) continue;
    std::vector<DrivenJoint> joints = reader->joints_behind(input, check);
    answer_later(joints, check.delayed(output, *input) ? 1 : 0,
                 base::to_seconds(output.owner().period()));
    for (DrivenJoint& joint : joints) all.push_back(std::move(joint));
  }
  return all;
}

std::string objection(const JointPlant& plant, const SampledController& controller,
                      double period_s) {
  if (control::has_margin(plant, controller, period_s)) return {};
  const auto loop = control::judge_loop(plant, controller, period_s);
  if (loop.has_margin()) return {};  // on the border, by rounding
  return control::objection_to_loop(loop) + " (" + figure(plant.inertia) +
         " kg m^2, sampled every " + figure(1e3 * period_s) + " ms" +
         (plant.delay_s < period_s
              ? ")"
              : ", answered " + figure(1e3 * plant.delay_s) +
                    " ms later: a connection of the loop has one_cycle_delay)");
}

}  // namespace

std::string figure(double number) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g", number);
  return text.data();
}

int cycles_late(const component::InputPortBase& input, const component::Check& check) {
  return check.once<CyclesLate>(&input, [&] { return count_cycles_late(input, check); }).count;
}

void answer_later(std::vector<DrivenJoint>& joints, int cycles, double period_s) {
  for (DrivenJoint& joint : joints) {
    joint.lightest.delay_s += cycles * period_s;
    joint.heaviest.delay_s += cycles * period_s;
  }
}

const std::vector<DrivenJoint>& joints_behind(const component::OutputPortBase& output,
                                              const component::Check& check) {
  return check.once<std::vector<DrivenJoint>>(&output,
                                              [&] { return find_joints_behind(output, check); });
}

std::string objection_to_gains(const DrivenJoint& joint, const SampledController& on_light,
                               const SampledController& on_heavy, double period_s) {
  std::string wrong = objection(joint.lightest, on_light, period_s);
  if (wrong.empty()) wrong = objection(joint.heaviest, on_heavy, period_s);
  return wrong.empty() ? wrong : joint.name + ": " + wrong;
}

std::string objection_to_gains(const DrivenJoint& joint, const SampledController& controller,
                               double period_s) {
  return objection_to_gains(joint, controller, controller, period_s);
}

std::string objection_to_gravity(const DrivenJoint& joint,
                                 const std::optional<std::array<double, 3>>& gravity) {
  const std::array<double, 3> computed = gravity.value_or(std::array<double, 3>{});
  const bool computes = size_of(computed) > kSameGravity;
  const bool weighs = size_of(joint.gravity) > kSameGravity && joint.most_weight > kNoWeight;
  if (computes && joint.holds_weight == HoldsWeight::kHardware) {
    return joint.name + ": its weight would be driven twice: gravity is " + text_of(computed) +
           ", and the hardware holds it too";
  }
  const bool left = joint.holds_weight == HoldsWeight::kCommands ||
                    (gravity && joint.holds_weight == HoldsWeight::kAnybody);
  if (!computes && weighs && left) {
    return joint.name + ": its weight of up to " + figure(joint.most_weight) +
           " Nm is not held: " + (gravity ? "gravity is 0" : "its controller has no model of it") +
           ", and the hardware leaves it to commands";
  }
  std::array<double, 3> difference{};
  for (std::size_t i = 0; i < 3; ++i) difference[i] = computed[i] - joint.gravity[i];
  if (computes && size_of(difference) > kSameGravity) {
    return joint.name + ": gravity is " + text_of(computed) + ", that of its hardware " +
           text_of(joint.gravity);
  }
  return {};
}

}  // namespace armature::controllers
