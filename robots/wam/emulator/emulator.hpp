// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"
#include "armature/can/virtual_bus.hpp"
#include "robots/wam/emulator/motors.hpp"
#include "robots/wam/emulator/puck.hpp"
#include "robots/wam/emulator/safety_board.hpp"

namespace armature::wam {

/// A WAM as its host sees it: a CAN bus with the safety board and a puck for each motor, in E-stop
/// at first. A host adds a station of its own to `bus()`; hosts in other processes are reached as
/// those of any virtual bus.
///
/// Time passes in `advance_to` alone: in simulated time two equal runs are equal to the bit; in
/// real time a thread calls it with the time that it is, often enough for the frames' times.
class Emulator {
 public:
  struct Config {
    std::vector<Puck::Config> pucks;  ///< one for each motor, nodes 1, 2, ...
    SafetyBoard::Config board{};
    /// Of the bus; above the pucks' own where frames have had their time elsewhere already.
    std::uint32_t bit_rate = kBitRate;
    /// The time that it is, asked when a host sends; none: how far the emulator has come. In real
    /// time the application's clock, which any thread may ask.
    can::VirtualBus::Clock clock{};
    std::string bus_name = "can0";
    base::Time begin{};
  };
  /// Pucks as the maker delivers them, with equal firmware.
  /// @param motors  4 or 7
  static Config standard(std::size_t motors, int version = 175);

  /// @param motors  outlives it
  /// An error says which puck does not fit its motor, or what the bus does not do.
  static base::Result<std::unique_ptr<Emulator>> make(const Config& config, Motors& motors);
  Emulator(const Emulator&) = delete;
  Emulator& operator=(const Emulator&) = delete;

  /// Everything up to and including `until` happens: frames, timers, motion.
  /// @rt nonblocking, no allocation but when pucks get power or wake up
  /// @thread always the same, also for all that is not the host's station
  void advance_to(base::Time until);
  /// Up to the next event of the bus, board or pucks, at most to `until`; for a host that waits for
  /// an answer in simulated time.
  /// @rt as `advance_to`
  void advance_to_next_event(base::Time until);
  base::Time now() const { return bus_.now(); }
  /// When that will be, as far as is known now.
  /// @rt nonblocking, no allocation
  base::Time next_event();

  can::VirtualBus& bus() { return bus_; }
  SafetyBoard& board() { return board_; }
  /// @param motor  from 0
  Puck& puck(std::size_t motor) { return *pucks_[motor]; }
  std::size_t motors() const { return pucks_.size(); }

 private:
  Emulator(const Config& config, Motors& motors);
  void run_timers();

  Motors& motors_;
  can::VirtualBus bus_;
  SafetyBoard board_;
  std::vector<std::unique_ptr<Puck>> pucks_;
  bool powered_ = false;
};

}  // namespace armature::wam
