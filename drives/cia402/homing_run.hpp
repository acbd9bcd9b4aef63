// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "drives/cia402/mode.hpp"
#include "drives/cia402/power.hpp"

namespace armature::cia402 {

/// How far a drive is that homes by itself, as its joint is told.
enum class HomingStage : std::uint8_t {
  kIdle,      ///< it is in its cyclic mode
  kUnderWay,  ///< it prepares, or moves by itself
  kAttained,  ///< its position is new, and it stands
  kFailed,    ///< it says so, or has fallen from its power
  kLeaving,   ///< it was told to stop, and goes back to its cyclic mode
};

/// The host's side of mode HM (CiA 402-2, chapter 11): a drive is put into it while it has no power
/// to move, and switched on when it shows that it is in it; then the start bit is raised, once. It
/// is left only when the drive has no power to move any more, so no drive follows the targets of a
/// cyclic mode behind its homing before it is switched on anew.
class HomingRun {
 public:
  /// What the drive says in a cycle.
  struct Seen {
    std::optional<PowerState> power;
    std::uint16_t status = 0;
    std::optional<std::int64_t> mode;  ///< 0x6061, as it came last
  };
  /// What the drive is told.
  struct Order {
    Mode mode = Mode::kNone;  ///< of 0x6060
    bool starts = false;      ///< bit 4 of the control word
    bool enables = false;     ///< in this cycle its goal becomes `kEnabled`
  };

  /// @param cyclic  the mode that the drive is in else
  /// @param moves   its method moves it; false: it is at home where it stands
  HomingRun(Mode cyclic, bool moves) : cyclic_(cyclic), moves_(moves) {}

  HomingStage stage() const;
  /// False, and nothing happens, unless it is idle.
  /// @rt nonblocking, no allocation
  bool begin() noexcept;
  /// The drive is told to stop, by whoever: the start bit falls at once.
  /// @rt nonblocking, no allocation
  void leave() noexcept;
  /// Once a cycle.
  /// @rt nonblocking, no allocation
  Order step(const Seen& seen) noexcept;

 private:
  enum class State : std::uint8_t {
    kIdle,
    kChangingMode,
    kSwitchingOn,
    kMoving,
    kAttained,
    kFailed,
    kStopping,  ///< until it has no power to move
    kReturning  ///< to its cyclic mode
  };

  void go_on(const Seen& seen) noexcept;
  void follow(std::uint16_t status) noexcept;

  Mode cyclic_;
  bool moves_;
  State state_ = State::kIdle;
  bool enables_ = false;
  bool has_begun_ = false;  ///< its status is of this run
  int cycles_ = 0;          ///< since the start bit rose
};

}  // namespace armature::cia402
