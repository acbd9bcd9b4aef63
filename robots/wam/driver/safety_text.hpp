// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "armature/component/outcome.hpp"
#include "armature/types/enum.hpp"
#include "robots/wam/driver/wam_driver.hpp"
#include "robots/wam/protocol/pendant_word.hpp"
#include "robots/wam/protocol/puck_protocol.hpp"

namespace armature::wam {

// What an operator reads of the arm's safety. Nonblocking, and allocates nothing.

/// The board's mode as paper 3 names it.
std::string_view safety_state(std::optional<BoardMode> mode);

/// What the safety board said last.
enum class SafetyState : std::int8_t { kUnknown = -1, kEstop = 0, kIdle = 1, kActivated = 2 };
ARMATURE_ENUM(SafetyState, kUnknown, kEstop, kIdle, kActivated);

inline SafetyState state_of_safety(std::optional<BoardMode> mode) {
  return mode ? static_cast<SafetyState>(*mode) : SafetyState::kUnknown;
}

/// Why the arm is out of service, and what the operator has to do.
/// @param node          of the puck, where the fault is one's
/// @param may_drive_on  nobody knows what its motor does: the first words are what saves
component::Reason fault_reason(WamFault fault, int node, bool may_drive_on = false);

/// What has to be pressed so that the arm becomes active, and why.
/// @param was_active  it was active before the run, whose pucks may be idle
std::string_view activation_request(const std::optional<PendantWord>& pendant, bool was_active);

/// Whether the pendant shows a fault, which keeps the arm from being activated.
bool shows_fault(const PendantWord& pendant);

}  // namespace armature::wam
