// SPDX-License-Identifier: Apache-2.0
#include "drives/cia402_components/drive_plan.hpp"

#include "armature/platform/file.hpp"
#include "drives/cia402/cycle_pdos.hpp"

namespace armature::cia402 {

using controllers::JointCommand;

Mode mode_of(CyclicMode mode) {
  if (mode == CyclicMode::kTorque) return Mode::kCyclicTorque;
  return mode == CyclicMode::kVelocity ? Mode::kCyclicVelocity : Mode::kCyclicPosition;
}

JointCommand command_of(CyclicMode mode) {
  if (mode == CyclicMode::kTorque) return JointCommand::kTorque;
  return mode == CyclicMode::kVelocity ? JointCommand::kVelocity : JointCommand::kPosition;
}

void DrivePlan::expect(int vendor, int product) {
  wish.identity = {.vendor = static_cast<std::uint32_t>(vendor),
                   .product = static_cast<std::uint32_t>(product)};
}

void DrivePlan::read_eds(base::Diagnostics& diagnostics) {
  eds.reset();
  if (eds_file.empty()) return;
  const auto text = platform::read_file(eds_file);
  if (!text) {
    diagnostics.error({}, "EDS of drive '" + wish.name + "': " + text.error(),
                      std::string("set eds to the file that its maker gives"));
    return;
  }
  eds = canopen::parse_eds(text.value(), eds_file, wish.node, diagnostics);
  if (!eds) return;
  check_eds(*eds, eds_file, wish, diagnostics);
  if (!temperature || eds->find(*temperature) != nullptr) return;
  diagnostics.error({eds_file, 0, 0},
                    "drive '" + wish.name + "': object " + to_text(*temperature) +
                        ", its temperature, is missing",
                    std::string("look for the temperature in this file"));
}

}  // namespace armature::cia402
