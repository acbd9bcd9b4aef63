// SPDX-License-Identifier: Apache-2.0
#include "drives/canopen/nmt.hpp"

namespace armature::canopen {
namespace {

bool is_nmt_command(std::uint8_t number) noexcept {
  switch (static_cast<NmtCommand>(number)) {
    case NmtCommand::kStart:
    case NmtCommand::kStop:
    case NmtCommand::kEnterPreOperational:
    case NmtCommand::kResetNode:
    case NmtCommand::kResetCommunication:
      return true;
  }
  return false;
}

}  // namespace

const char* to_text(NmtState state) noexcept {
  switch (state) {
    case NmtState::kBootUp:
      return "booting";
    case NmtState::kStopped:
      return "stopped";
    case NmtState::kOperational:
      return "operational";
    case NmtState::kPreOperational:
      return "pre-operational";
  }
  return "unknown";
}

bool is_nmt_state(std::uint8_t number) noexcept {
  switch (static_cast<NmtState>(number)) {
    case NmtState::kBootUp:
    case NmtState::kStopped:
    case NmtState::kOperational:
    case NmtState::kPreOperational:
      return true;
  }
  return false;
}

can::Frame nmt_frame(NmtCommand command, NodeId node) noexcept {
  return can::data_frame(cob_id::kNmt, {static_cast<std::uint8_t>(command), node});
}

std::optional<NmtCommand> parse_nmt(const can::Frame& frame, NodeId node) noexcept {
  if (origin_of(frame).service != Service::kNmt || frame.size < 2) return std::nullopt;
  if (frame.data[1] != node && frame.data[1] != kEveryNode) return std::nullopt;
  if (!is_nmt_command(frame.data[0])) return std::nullopt;
  return static_cast<NmtCommand>(frame.data[0]);
}

NmtSlave::Reset NmtSlave::take(NmtCommand command) noexcept {
  switch (command) {
    case NmtCommand::kStart:
      state_ = NmtState::kOperational;
      return Reset::kNone;
    case NmtCommand::kStop:
      state_ = NmtState::kStopped;
      return Reset::kNone;
    case NmtCommand::kEnterPreOperational:
      state_ = NmtState::kPreOperational;
      return Reset::kNone;
    case NmtCommand::kResetNode:
      state_ = NmtState::kBootUp;
      return Reset::kNode;
    case NmtCommand::kResetCommunication:
      state_ = NmtState::kBootUp;
      return Reset::kCommunication;
  }
  return Reset::kNone;
}

}  // namespace armature::canopen
