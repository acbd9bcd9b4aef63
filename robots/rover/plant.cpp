// SPDX-License-Identifier: Apache-2.0
#include "robots/rover/plant.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "robots/rover/description.hpp"
#include "robots/rover/numbers.hpp"

namespace armature::rover {

base::Result<std::unique_ptr<Plant>> Plant::make(const Config& config) {
  if (config.wheels != 2 && config.wheels != 4) {
    return base::Error{"the rover has " + std::to_string(config.wheels) +
                       " wheels, expected 2 or 4"};
  }
  auto world =
      sim::World::parse(description(config.wheels), "rover", {.inner_step = config.inner_step});
  if (!world) return base::Error{world.error()};
  std::vector<Drive> drives;
  for (int number = 1; number <= config.wheels; ++number) {
    const auto axle = world.value().find_joint("axle" + std::to_string(number));
    drives.push_back({.axle = axle.value(),
                      .motor = sim::Motor::make({kMotor, kSupplyVoltage}).value(),
                      .encoder = sim::Encoder(kCountsPerTurn, kMotor.gear_ratio)});
    drives.back().motor.set_voltage(0.0);
  }
  const std::size_t body = world.value().find_body("rover").value();
  return std::unique_ptr<Plant>(
      new Plant(std::move(world).value(), body, std::move(drives), config.begin));
}

Plant::Plant(sim::World world, std::size_t body, std::vector<Drive> drives, base::Time begin)
    : world_(std::move(world)), body_(body), drives_(std::move(drives)), begin_(begin) {}

/// The back-EMF makes the torque a matter of each inner step.
void Plant::advance_to(base::Time now) {
  while (reached() + world_.inner_step() <= now) {
    for (Drive& drive : drives_) world_.set_effort(drive.axle, torque(drive));
    if (world_.step(world_.inner_step()) != sim::PlantStatus::kGood) return;
  }
}

/// [N m] at the wheel
double Plant::torque(Drive& drive) const {
  if (drive.on && reached() - drive.told_at >= kWatchdog) {
    drive.on = false;
    drive.motor.set_voltage(0.0);
  }
  return drive.broken ? 0.0 : drive.motor.torque(world_.velocity(drive.axle));
}

void Plant::switch_on(std::size_t wheel, base::Time now) {
  advance_to(now);
  drives_[wheel].on = true;
  drives_[wheel].told_at = now;
}

void Plant::switch_off(std::size_t wheel, base::Time now) {
  advance_to(now);
  drives_[wheel].on = false;
  drives_[wheel].motor.set_voltage(0.0);
}

void Plant::drive(std::size_t wheel, double voltage, base::Time now) {
  advance_to(now);
  Drive& drive = drives_[wheel];
  drive.told_at = now;
  drive.motor.set_voltage(drive.on ? voltage : 0.0);
}

std::int64_t Plant::take_counts(std::size_t wheel, base::Time now) {
  advance_to(now);
  return drives_[wheel].encoder.displacement(wheel_angle(wheel));
}

Place Plant::place() const {
  const sim::Pose pose = world_.pose(body_);
  const auto [w, x, y, z] = pose.orientation;
  const double heading = std::atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z));
  return {pose.position[0], pose.position[1], heading};
}

void Plant::put(const Place& place) {
  world_.place(body_, {{place.x, place.y, kWheelRadius},
                       {std::cos(0.5 * place.heading), 0.0, 0.0, std::sin(0.5 * place.heading)}});
}

}  // namespace armature::rover
