// SPDX-License-Identifier: Apache-2.0
#include "drives/cia402/plant_arm.hpp"

#include <cmath>
#include <utility>

#include "armature/base/as_reason.hpp"
#include "armature/base/quoted.hpp"
#include "armature/control/dynamics/joint_inertias.hpp"
#include "armature/platform/file.hpp"
#include "armature/sim/plant.hpp"

namespace armature::cia402 {
namespace {

constexpr double kHoldingTorque = 1000.0;  // N m, of a brake
constexpr double kRoom = 100.0;            // rad to both sides, of a joint that turns without end

/// What the drives are tuned for, from light to heavy poses.
double inertia_between(const control::JointRange& range, double rotor) {
  return std::sqrt((range.least_inertia + rotor) * (range.most_inertia + rotor));
}

class ArmOfPlant final : public EmulatedArm {
 public:
  ArmOfPlant(sim::Plant plant, std::vector<double> start, std::vector<Axis::Config> axes)
      : plant_(std::move(plant)), start_(std::move(start)), axes_(std::move(axes)) {
    held_.resize(joints());
    for (std::size_t i = 0; i < joints(); ++i) {
      plant_.set_state(i, start_[i], 0.0);
      hold(i);
    }
  }

  std::size_t joints() const override { return axes_.size(); }
  Axis::Config axis(std::size_t joint) const override { return axes_[joint]; }
  double position(std::size_t joint) const override {
    return plant_.position(joint) - start_[joint];
  }
  double velocity(std::size_t joint) const override { return plant_.velocity(joint); }

  void push(std::size_t joint, double torque) override {
    if (held_[joint]) plant_.set_brake(joint, 0.0);
    held_[joint] = false;
    plant_.set_effort(joint, torque);
  }
  void hold(std::size_t joint) override {
    if (held_[joint]) return;
    held_[joint] = true;
    plant_.set_effort(joint, 0.0);
    plant_.set_brake(joint, kHoldingTorque);
  }
  void step(base::Duration by) override { plant_.step(by); }

 private:
  sim::Plant plant_;
  const std::vector<double> start_;
  const std::vector<Axis::Config> axes_;
  std::vector<bool> held_;
};

Axis::Config axis_for(const control::JointLimits& limits, const control::JointRange& range,
                      double rotor, double start) {
  Axis::Config axis;
  axis.inertia = inertia_between(range, rotor);
  if (std::isfinite(limits.max_effort)) axis.most_torque = limits.max_effort;
  axis.low = std::isfinite(limits.lower) ? limits.lower - start : -kRoom;
  axis.high = std::isfinite(limits.upper) ? limits.upper - start : kRoom;
  return axis;
}

}  // namespace

base::Result<std::unique_ptr<EmulatedArm>> PlantArm::make() const {
  const auto urdf = platform::read_file(file);
  if (!urdf) return base::Error{urdf.error()};
  base::Diagnostics diagnostics;
  auto links = control::InverseDynamics::parse(urdf.value(), file, {}, diagnostics);
  if (!links) return base::Error{base::quoted(file) + ": " + base::as_reason(diagnostics)};
  const std::size_t joints = links->joints();
  if (!start.empty() && start.size() != joints) {
    return base::Error{base::quoted(file) + " has " + std::to_string(joints) +
                       " joints that move, and the start " + std::to_string(start.size()) +
                       " numbers; give one for each joint"};
  }
  const std::vector<double> begin = start.empty() ? std::vector<double>(joints) : start;
  const auto ranges = control::find_joint_ranges(*links, nullptr, control::search_limits(*links));
  sim::Plant::Options options;
  std::vector<Axis::Config> axes;
  for (std::size_t i = 0; i < joints; ++i) {
    options.armature[links->joint_names()[i]] = rotor_inertia;
    axes.push_back(axis_for(links->limits()[i], ranges[i], rotor_inertia, begin[i]));
  }
  auto plant = sim::Plant::load(file, options);
  if (!plant) return base::Error{plant.error()};
  if (plant.value().joints() != joints) {
    return base::Error{base::quoted(file) + " has branches: expected joints one after the other"};
  }
  return std::unique_ptr<EmulatedArm>(
      std::make_unique<ArmOfPlant>(std::move(plant).value(), begin, std::move(axes)));
}

}  // namespace armature::cia402
