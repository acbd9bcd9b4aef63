// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

namespace armature::report {

/// What the page marks on the time axis of every curve.
enum class MomentKind { kArmed, kReset, kDisarmed, kStopped, kFault, kEstop };  // graver ones last

/// As run.json has it, and as the page shows it.
inline std::string_view name_of(MomentKind kind) {
  switch (kind) {
    case MomentKind::kArmed:
      return "armed";
    case MomentKind::kReset:
      return "reset";
    case MomentKind::kDisarmed:
      return "disarmed";
    case MomentKind::kStopped:
      return "stopped";
    case MomentKind::kFault:
      return "fault";
    case MomentKind::kEstop:
      return "E-stop";
  }
  return "unknown";
}

/// Which of them a component's log line tells: `armed`, `disarmed...`, `fault: ...`, `stopped: ...`
/// and `reset` are what the robot's components and the runtime log.
/// @return none: it tells something else
inline std::optional<MomentKind> moment_told_by(std::string_view message) {
  if (message == "armed") return MomentKind::kArmed;
  if (message == "reset") return MomentKind::kReset;
  if (message.starts_with("fault: E-stop")) return MomentKind::kEstop;
  if (message.starts_with("fault: ")) return MomentKind::kFault;
  if (message.starts_with("stopped: ")) return MomentKind::kStopped;
  if (message.starts_with("disarmed") || message.ends_with("it is disarmed")) {
    return MomentKind::kDisarmed;
  }
  return std::nullopt;
}

}  // namespace armature::report
