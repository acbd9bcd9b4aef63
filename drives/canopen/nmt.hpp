// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "armature/can/frame.hpp"
#include "drives/canopen/cob_id.hpp"

namespace armature::canopen {

/// What a master tells devices (CiA 301, 7.2.8.3).
enum class NmtCommand : std::uint8_t {
  kStart = 0x01,
  kStop = 0x02,
  kEnterPreOperational = 0x80,
  kResetNode = 0x81,
  kResetCommunication = 0x82,
};

/// How a device says in its heartbeat that it is.
enum class NmtState : std::uint8_t {
  kBootUp = 0x00,  ///< said once, after a reset
  kStopped = 0x04,
  kOperational = 0x05,
  kPreOperational = 0x7f,
};
const char* to_text(NmtState state) noexcept;
bool is_nmt_state(std::uint8_t number) noexcept;

/// The frame of a command.
/// @param node  the device, or `kEveryNode`
/// @rt nonblocking, no allocation
can::Frame nmt_frame(NmtCommand command, NodeId node) noexcept;

/// The command that the frame has for `node`; none if it is another frame, or for others.
/// @rt nonblocking, no allocation
std::optional<NmtCommand> parse_nmt(const can::Frame& frame, NodeId node) noexcept;

/// The state of a device that follows its master.
class NmtSlave {
 public:
  /// What a command asks of the device beyond the state.
  enum class Reset : std::uint8_t { kNone, kNode, kCommunication };

  /// In `kBootUp` first; `booted` is called when the boot-up frame is on its way.
  NmtState state() const { return state_; }
  /// @rt nonblocking, no allocation
  void booted() noexcept { state_ = NmtState::kPreOperational; }
  /// @rt nonblocking, no allocation
  Reset take(NmtCommand command) noexcept;

 private:
  NmtState state_ = NmtState::kBootUp;
};

}  // namespace armature::canopen
