// SPDX-License-Identifier: Apache-2.0
#include "drives/cia402/emulated_bus.hpp"

#include <algorithm>

#include "armature/base/diagnostic.hpp"

namespace armature::cia402 {

base::Result<std::unique_ptr<EmulatedBus>> EmulatedBus::make(const Config& config) {
  const std::size_t last = config.first_node + config.drives - 1;
  if (config.first_node == 0 || config.drives == 0 || last > canopen::kLastNode) {
    return base::Error{"expected nodes from 1 to 127, found " + std::to_string(config.first_node) +
                       " to " + std::to_string(last) + " (use fewer drives)"};
  }
  if (config.arm != nullptr && config.arm->joints() != config.drives) {
    return base::Error{"the arm has " + std::to_string(config.arm->joints()) +
                       " joints, expected one for each of " + std::to_string(config.drives) +
                       " drives"};
  }
  const auto scaling = Scaling::make(config.drive.factors, PositionUnit::kIncrements);
  if (!scaling) return base::Error{scaling.error()};
  return std::unique_ptr<EmulatedBus>(new EmulatedBus(config));
}

EmulatedBus::EmulatedBus(const Config& config)
    : arm_(config.arm), arm_now_(config.begin), bus_(config.name, config.bit_rate, config.clock) {
  base::Diagnostics none;  // a new station with these options always opens
  for (std::size_t i = 0; i < config.drives; ++i) {
    EmulatedDrive::Config drive = config.drive;
    drive.node = static_cast<canopen::NodeId>(config.first_node + i);
    drive.identity.serial = drive.node;
    if (arm_ != nullptr) {
      drive.axis = arm_->axis(i);
      drive.axis.arm = arm_.get();
      drive.axis.joint = i;
    }
    can::VirtualStation& station = bus_.add_station("node" + std::to_string(drive.node));
    static_cast<void>(station.open({}, none));
    stations_.push_back(&station);
    drives_.push_back(std::make_unique<EmulatedDrive>(drive, station, config.begin));
  }
}

EmulatedDrive* EmulatedBus::find(unsigned node) {
  for (const auto& drive : drives_) {
    if (drive->device().node() == node) return drive.get();
  }
  return nullptr;
}

void EmulatedBus::advance_to(base::Time now) {
  if (arm_ != nullptr) return advance_arm_to(now);
  bus_.advance_to(now);
  for (const auto& drive : drives_) drive->advance_to(now);
}

/// Step by step: what one joint does, the others feel.
void EmulatedBus::advance_arm_to(base::Time now) {
  do {
    const base::Time next = std::clamp(now, arm_now_, arm_now_ + EmulatedDrive::kStep);
    bus_.advance_to(next);
    for (const auto& drive : drives_) drive->advance_to(next);
    arm_->step(next - arm_now_);
    arm_now_ = next;
  } while (arm_now_ < now);
}

}  // namespace armature::cia402
