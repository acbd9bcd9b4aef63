// SPDX-License-Identifier: Apache-2.0
#include "drives/cia402_components/cia402_bus.hpp"

#include <array>

#include "drives/canopen/pdo.hpp"
#include "drives/canopen/sync.hpp"
#include "drives/cia402/power.hpp"

namespace armature::cia402 {
namespace {

/// Every state in which the motor has no voltage, or brakes for the last time.
constexpr std::array kIdleStates{PowerState::kNotReadyToSwitchOn, PowerState::kSwitchOnDisabled,
                                 PowerState::kReadyToSwitchOn, PowerState::kSwitchedOn,
                                 PowerState::kFault};
/// Bits that tell the state: 0x6F where a quick stop counts, else 0x4F (CiA 402-2, table 30).
constexpr std::uint8_t mask_of(PowerState state) {
  const bool ready = state == PowerState::kReadyToSwitchOn || state == PowerState::kSwitchedOn;
  return ready ? 0x6f : 0x4f;
}

}  // namespace

/// Its PDOs begin with control and status word; a target of 0 counts for nothing in a quick stop.
guardian::Orders guard_orders(const DriveGroup& drives, const std::string& bus,
                              std::uint32_t bit_rate, base::Duration period) {
  guardian::Orders orders;
  orders.bus = bus;
  orders.bit_rate = bit_rate;
  orders.period = period;
  const can::Frame sync = canopen::SyncProducer().step();
  for (std::size_t device = 0; device < drives.size(); ++device) {
    const DriveConfig& drive = drives.config(device);
    const std::uint64_t word[] = {encode_command(PowerCommand::kQuickStop)};
    orders.safe.push_back(canopen::pack(drive.receive.front(), word));
    for (const PowerState state : kIdleStates) {
      const std::uint64_t status[] = {std::uint64_t{encode_state(state)} & mask_of(state)};
      const can::Frame answer = canopen::pack(drive.transmit.front(), status);
      orders.answers.push_back({.device = device, .frame = answer, .mask = {mask_of(state)}});
    }
  }
  orders.safe.push_back(sync);
  orders.questions.push_back(sync);
  orders.answers_filter = {.id = 0x180, .mask = 0x780};
  return orders;
}

component::Outcome Cia402Bus::begin_to_guard() {
  if (is_simulated()) return component::accepted();
  const component::Outcome outcome =
      guard_.start(guard_orders(*group(), bus_.get(), bit_rate(), cycle()));
  if (!outcome || guard_.said().empty()) return outcome;
  guard_.complains() ? log_warning("{}", guard_.said()) : log_info("{}", guard_.said());
  return outcome;
}

bool Cia402Bus::is_guarded() {
  if (const auto reason = guard_.beat(time())) {
    make_safe();
    fault(reason->view());
    return false;
  }
  if (guard_.take_loss()) {
    log_error(
        "its guardian has died: if this process does, the drives' own watch of SYNC stops "
        "the joints");
  }
  return true;
}

}  // namespace armature::cia402
