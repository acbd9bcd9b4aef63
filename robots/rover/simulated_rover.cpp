// SPDX-License-Identifier: Apache-2.0
#include "robots/rover/simulated_rover.hpp"

#include <cmath>
#include <utility>

namespace armature::rover {

using component::Outcome;

Outcome SimulatedRover::on_configure() {
  auto made = Plant::make({.wheels = wheels_, .begin = time()});
  if (!made) return component::refused(made.error());
  plant_ = std::move(made).value();
  return component::accepted();
}

Outcome SimulatedRover::on_start() {
  place_.write(plant_->place());
  return component::accepted();
}

void SimulatedRover::on_stop() {
  for (std::size_t wheel = 0; wheel < plant_->wheels(); ++wheel) plant_->switch_off(wheel, time());
}

void SimulatedRover::let_time_pass() {
  for (std::size_t wheel = 0; wheel < plant_->wheels(); ++wheel) {
    plant_->break_motor(wheel, index_of(dead_motor_) == wheel);
  }
  plant_->advance_to(time());
  if (plant_->status() != sim::PlantStatus::kGood) {
    fault("the simulated rover cannot be: its state is not finite");
    return;
  }
  place_.write(plant_->place());
}

std::optional<std::size_t> SimulatedRover::index_of(int number) const {
  if (plant_ == nullptr || number < 1 || number > static_cast<int>(plant_->wheels())) {
    return std::nullopt;
  }
  return static_cast<std::size_t>(number - 1);
}

WheelSample SimulatedRover::read_wheel(int number) {
  const auto wheel = index_of(number);
  if (!wheel || number == silent_encoder_) return {};
  return {
      .counts = plant_->take_counts(*wheel, time()), .fresh = true, .on = plant_->is_on(*wheel)};
}

bool SimulatedRover::set_wheel(int number, control::LimitedEffort effort) {
  const auto wheel = index_of(number);
  if (wheel) plant_->drive(*wheel, effort, time());
  return wheel.has_value();
}

bool SimulatedRover::wheel_on(int number, control::DrivePermit permit) {
  const auto wheel = index_of(number);
  if (!wheel || !permit) return false;
  plant_->switch_on(*wheel, time());
  return true;
}

bool SimulatedRover::wheel_off(int number) {
  const auto wheel = index_of(number);
  if (wheel) plant_->switch_off(*wheel, time());
  return wheel.has_value();
}

void SimulatedRover::put(double x, double y, double heading) {
  if (plant_ == nullptr || !std::isfinite(x) || !std::isfinite(y) || !std::isfinite(heading))
    return;
  plant_->put({x, y, heading});
}

}  // namespace armature::rover
