// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"
#include "armature/can/bus.hpp"
#include "drives/canopen/emergency.hpp"
#include "drives/canopen/heartbeat.hpp"
#include "drives/canopen/pdo.hpp"
#include "drives/canopen/sdo_channel.hpp"
#include "drives/canopen/sync.hpp"
#include "drives/cia402/mode.hpp"
#include "drives/cia402/power.hpp"
#include "drives/cia402/scaling.hpp"

namespace armature::cia402 {

/// How one drive takes part in a group's cycle; `prepare_drive` makes it with the drive itself.
struct DriveConfig {
  canopen::NodeId node = 0;
  std::string name;                   ///< for messages
  Mode mode = Mode::kCyclicPosition;  ///< CSP, CSV or CST
  Scaling scaling;
  std::vector<canopen::Pdo> receive;     ///< the drive's; with control word and the mode's target
  std::vector<canopen::Pdo> transmit;    ///< the drive's; with status word and position
  base::Duration heartbeat_timeout{};    ///< 0: its heartbeat is not watched
  std::uint32_t most_silent_cycles = 5;  ///< without an answer, then it is told to stop quickly
  std::vector<canopen::SdoStep> preparation{};  ///< for when it lost its power
  std::vector<canopen::Address> slow{};         ///< numbers that are asked by SDO, now and then
};

/// What is known of a drive after a cycle.
struct DriveState {
  std::optional<PowerState> power;  ///< none: its status word is of no state, or none has come
  std::uint16_t status = 0;         ///< see `status_bit`
  double position = 0.0;            ///< [rad] of the driving shaft
  double velocity = 0.0;  ///< [rad/s]; where the drive sends none, of its last two positions
  double effort = 0.0;    ///< [N m] at the driving shaft; 0 where the drive sends none
  base::Time time{};      ///< when its position came
  std::uint32_t silent_cycles = 0;  ///< since its last answer
  canopen::Presence presence = canopen::Presence::kAwaited;
  std::uint32_t reboots = 0;                    ///< since the group began
  std::optional<canopen::Emergency> emergency;  ///< the last one whose error is not gone
  std::uint16_t error_code = 0;                 ///< 0x603F, where it is mapped

  bool enabled() const { return power == PowerState::kOperationEnabled; }
  bool failed() const {
    return power == PowerState::kFault || power == PowerState::kFaultReactionActive;
  }
  bool warns() const { return (status & status_bit::kWarning) != 0; }
  /// It follows the targets of its cyclic mode.
  bool follows() const { return enabled() && (status & status_bit::kFollowsCommand) != 0; }
  bool limited() const { return (status & status_bit::kInternalLimit) != 0; }
};

/// All drives on a bus, in the cycle of their host: it takes what has come, and sends targets and
/// one SYNC. Drives take the targets of a cycle and answer at its SYNC.
///
/// A drive that is not enabled is told its own position, velocity 0 or torque 0 as its target,
/// so enabling it moves nothing; targets count from the cycle after it is enabled. A drive that
/// does not answer or has lost its heartbeat is told to stop quickly, one that has rebooted to
/// switch off, until its goal is given anew. What has rebooted has to be prepared again.
/// @thread the host's alone
class DriveGroup {
 public:
  /// An error names the drive and what its configuration lacks.
  /// @param sync_overflow  of the counter in SYNC; 0: none
  static base::Result<DriveGroup> make(std::vector<DriveConfig> drives,
                                       std::uint8_t sync_overflow = 0);

  std::size_t size() const { return drives_.size(); }
  const DriveConfig& config(std::size_t drive) const { return drives_[drive].config; }
  const DriveState& state(std::size_t drive) const { return drives_[drive].state; }

  /// From now on drives hear that their host is there.
  /// @param node    of the host
  /// @param period  0: they do not
  void set_heartbeat(canopen::NodeId node, base::Duration period, base::Time now);

  /// Uses a frame that has come, of whatever kind.
  /// @rt nonblocking, no allocation, O(drives)
  void take(const can::Arrival& arrival) noexcept;

  /// How far the drive shall be; given once, it holds until a fault, quick stop, reboot or loss.
  /// @rt nonblocking, no allocation
  void set_goal(std::size_t drive, PowerGoal goal) noexcept;
  /// The operator's word: see `PowerControl::ask_reset`.
  /// @rt nonblocking, no allocation
  void ask_reset(std::size_t drive) noexcept;
  /// @rt nonblocking, no allocation
  void set_halt(std::size_t drive, bool halt) noexcept;
  /// The mode that it is told, where an RPDO has it, and the bit of that mode in the control word.
  /// @rt nonblocking, no allocation
  void set_mode(std::size_t drive, Mode mode, bool start) noexcept;
  /// @param target  [rad], [rad/s] or [N m], as the drive's mode has it
  /// @rt nonblocking, no allocation
  void set_target(std::size_t drive, double target) noexcept;

  /// Sends all targets, SYNC, and the heartbeat that is due.
  /// @return how many frames the bus did not take
  /// @rt nonblocking, no allocation, O(drives)
  std::size_t step(can::Bus& bus, base::Time now) noexcept;

 private:
  /// Where a value is in the PDOs; none if it is in none.
  struct Place {
    std::size_t pdo = 0;
    std::size_t object = 0;
  };
  struct Drive {
    DriveConfig config;
    DriveState state;
    PowerControl power;
    std::vector<std::vector<std::uint64_t>> sent;
    std::vector<std::vector<std::uint64_t>> received;
    Place control;
    Place target;
    Place status;
    Place position;
    std::optional<Place> mode;
    std::optional<Place> velocity;
    std::optional<Place> torque;
    std::optional<Place> error_code;
    double wanted = 0.0;
    bool halt = false;
    Mode told_mode = Mode::kNone;
    bool start = false;  ///< the bit of that mode
    bool answered = false;
    std::uint32_t boot_ups = 0;
  };

  explicit DriveGroup(std::uint8_t sync_overflow) : sync_(sync_overflow) {}
  static base::Result<Drive> make_drive(DriveConfig config);
  static std::optional<Place> find(const std::vector<canopen::Pdo>& pdos, canopen::Address address);
  void use(Drive& drive, std::size_t pdo, base::Time time) noexcept;
  void watch(Drive& drive) noexcept;
  static void fill(Drive& drive) noexcept;

  std::vector<Drive> drives_;
  canopen::SyncProducer sync_;
  canopen::HeartbeatConsumer heartbeats_;
  canopen::HeartbeatProducer heartbeat_{0};
};

}  // namespace armature::cia402
