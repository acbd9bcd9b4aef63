// SPDX-License-Identifier: Apache-2.0
#include "drives/cia402/emulated_bus.hpp"

#include "armature/base/diagnostic.hpp"

namespace armature::cia402 {

base::Result<std::unique_ptr<EmulatedBus>> EmulatedBus::make(const Config& config) {
  const std::size_t last = config.first_node + config.drives - 1;
  if (config.first_node == 0 || config.drives == 0 || last > canopen::kLastNode) {
    return base::Error{"expected nodes from 1 to 127, found " + std::to_string(config.first_node) +
                       " to " + std::to_string(last) + " (use fewer drives)"};
  }
  const auto scaling = Scaling::make(config.drive.factors, PositionUnit::kIncrements);
  if (!scaling) return base::Error{scaling.error()};
  return std::unique_ptr<EmulatedBus>(new EmulatedBus(config));
}

EmulatedBus::EmulatedBus(const Config& config) : bus_(config.name, config.bit_rate, config.clock) {
  base::Diagnostics none;  // a new station with these options always opens
  for (std::size_t i = 0; i < config.drives; ++i) {
    EmulatedDrive::Config drive = config.drive;
    drive.node = static_cast<canopen::NodeId>(config.first_node + i);
    drive.identity.serial = drive.node;
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
  bus_.advance_to(now);
  for (const auto& drive : drives_) drive->advance_to(now);
}

}  // namespace armature::cia402
