// SPDX-License-Identifier: Apache-2.0
#include "robots/janus/head.hpp"

#include <optional>
#include <utility>

#include "armature/base/seconds.hpp"
#include "armature/sim/brake.hpp"
#include "armature/sim/encoder.hpp"
#include "armature/sim/index_switch.hpp"
#include "armature/sim/motor.hpp"

namespace armature::janus {
namespace {

constexpr std::array<const char*, kJoints> kJointNames{"joint1", "joint2"};
constexpr std::size_t kJointWithBrake = 1;

sim::Plant::Options options_for(const Head::Config& config) {
  constexpr double kArmature = kMotor.rotor_inertia * kMotor.gear_ratio * kMotor.gear_ratio;
  sim::Plant::Options options;
  options.inner_step = config.inner_step;
  for (const char* name : kJointNames) options.armature[name] = kArmature;
  return options;
}

base::Result<void> check_joints(const sim::Plant& plant, const std::string& file) {
  if (plant.joints() == kJoints && plant.name(0) == kJointNames[0] &&
      plant.name(1) == kJointNames[1]) {
    return {};
  }
  return base::Error{file + ": expected the moving joints joint1 and joint2, in this order"};
}

}  // namespace

/// One joint, as its card has it.
class Head::Wiring final : public AicWiring {
 public:
  Wiring(Head& head, std::size_t joint)
      : head_(head),
        joint_(joint),
        motor_(sim::Motor::make({kMotor, kSupplyVoltage}).value()),
        encoder_(kCountsPerTurn, kMotor.gear_ratio) {
    if (joint == kJointWithBrake) brake_.emplace(head.plant_, joint, kBrakeTorque);
    encoder_.restart(head.plant_.position(joint));
  }

  std::int64_t take_counts(base::Time now) override {
    return encoder_.displacement(head_.position(joint_, now));
  }
  bool index_closed(base::Time now) override { return index_.closed(head_.position(joint_, now)); }
  double motor_current(base::Time now) override {
    return motor_.current(head_.velocity(joint_, now));
  }
  void drive(double share, base::Time now) override {
    head_.advance_to(now);
    motor_.set_voltage(share * motor_.supply());
  }
  void switch_off(base::Time now) override {
    head_.advance_to(now);
    motor_.switch_off();
  }
  void apply_brake(base::Time now) override {
    head_.advance_to(now);
    if (brake_) brake_->apply();
  }
  void release_brake(base::Time now) override {
    head_.advance_to(now);
    if (brake_) brake_->release();
  }

  double torque(double velocity) const { return motor_.torque(velocity); }

 private:
  Head& head_;
  std::size_t joint_;
  sim::Motor motor_;
  sim::Encoder encoder_;
  sim::IndexSwitch index_{.centre = 0.0, .half_width = kIndexHalfWidth};
  std::optional<sim::Brake> brake_;
};

base::Result<std::unique_ptr<Head>> Head::load(const Config& config) {
  auto plant = sim::Plant::load(config.urdf_file, options_for(config));
  return assemble(std::move(plant), config);
}

base::Result<std::unique_ptr<Head>> Head::parse(const std::string& urdf, const Config& config) {
  return assemble(sim::Plant::parse(urdf, config.urdf_file, options_for(config)), config);
}

base::Result<std::unique_ptr<Head>> Head::assemble(base::Result<sim::Plant> plant,
                                                   const Config& config) {
  if (!plant) return base::Error{plant.error()};
  if (const auto checked = check_joints(plant.value(), config.urdf_file); !checked) {
    return base::Error{checked.error()};
  }
  return std::unique_ptr<Head>(new Head(std::move(plant).value(), config));
}

Head::Head(sim::Plant plant, const Config& config)
    : begin_(config.begin), plant_(std::move(plant)) {
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
    plant_.set_state(joint, config.initial_position[joint], 0.0);
    wirings_[joint] = std::make_unique<Wiring>(*this, joint);
  }
}

Head::~Head() = default;

AicWiring& Head::wiring(std::size_t joint) { return *wirings_[joint]; }

/// The back-EMF makes the torque a matter of each inner step.
void Head::advance_to(base::Time now) {
  while (reached() + plant_.inner_step() <= now) {
    for (std::size_t joint = 0; joint < kJoints; ++joint) {
      plant_.set_effort(joint, wirings_[joint]->torque(plant_.velocity(joint)));
    }
    if (plant_.step(plant_.inner_step()) != sim::PlantStatus::kGood) return;
  }
}

/// Between two inner steps a joint moves on with its velocity.
double Head::position(std::size_t joint, base::Time now) {
  advance_to(now);
  if (status() == sim::PlantStatus::kDiverged) return plant_.position(joint);
  return plant_.position(joint) + plant_.velocity(joint) * base::to_seconds(now - reached());
}

double Head::velocity(std::size_t joint, base::Time now) {
  advance_to(now);
  return status() == sim::PlantStatus::kDiverged ? 0.0 : plant_.velocity(joint);
}

}  // namespace armature::janus
