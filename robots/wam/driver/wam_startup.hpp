// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "armature/base/diagnostic.hpp"
#include "armature/base/result.hpp"
#include "armature/base/time.hpp"
#include "armature/can/bus.hpp"
#include "robots/wam/driver/conversation.hpp"
#include "robots/wam/driver/wam_record.hpp"
#include "robots/wam/protocol/puck_properties.hpp"
#include "robots/wam/protocol/puck_protocol.hpp"

namespace armature::wam {

enum class WamProgress {
  kTalking,         ///< poll again when a frame has come, or at the deadline
  kWaitingForIdle,  ///< the same, but the operator has to act: E-stop out, then Shift+Idle
  kDone,            ///< nothing is left of what was begun last
  kFailed,          ///< `diagnostics` say why
};

/// The conversation between power-up and the cycle, step by step as PROTOCOL.md has it:
///
///     startup->connect(now);
///     while (startup->poll(now) <= WamProgress::kWaitingForIdle) { /* sleep until news, deadline
///     */ }
///     // the operator has put the arm at home, unless startup->record().zeroed
///     startup->zero(now);
///     ...
///     WamDriver::make(bus, startup->record(), {})
///
/// It never lets anything move: pucks are left idle, and the board's mode to the operator. The
/// control cycle must not run meanwhile. For configuration, not for real-time threads. One thread
/// uses it; it is the bus's sender and receiver.
class WamStartup {
 public:
  struct Config {
    std::size_t motors = kMostMotors;  ///< 4 or 7: which arm it has to be
    /// Angles of the motors [rad] at the home position, for `zero`.
    std::array<double, kMostMotors> home{};
    base::Duration presence_window = std::chrono::milliseconds(5);  ///< for a node to show itself
    base::Duration answer_window = std::chrono::milliseconds(20);   ///< for a property's value
    base::Duration boot_timeout = std::chrono::seconds(4);  ///< from idle until all pucks answer
  };

  /// @param bus  opened as `WamDriver::bus_options` has it; outlives this
  /// An error names what is wrong in the configuration.
  static base::Result<std::unique_ptr<WamStartup>> make(can::Bus& bus, const Config& config);
  WamStartup(const WamStartup&) = delete;
  WamStartup& operator=(const WamStartup&) = delete;

  /// Begins anew: finds the devices, puts the board's limits back to their defaults, waits for
  /// idle, wakes the pucks, reads what they are.
  void connect(base::Time now);
  /// Begins to write the home position into the pucks, unless the board says that they have theirs;
  /// after `connect` is done. Nothing may move meanwhile.
  void zero(base::Time now);

  WamProgress poll(base::Time now);
  base::Time deadline() const { return talk_.deadline(); }

  const WamRecord& record() const { return record_; }
  /// MODE as the board said last; none before it said anything.
  std::optional<BoardMode> board_mode() const { return board_mode_; }
  /// Errors, and warnings of what is odd but works.
  const base::Diagnostics& diagnostics() const { return diagnostics_; }
  const Conversation::Counters& counters() const { return talk_.counters(); }

 private:
  /// What a node said of itself when it was found.
  struct Node {
    std::optional<int> status;
    int role = 0;
    int version = 0;
  };

  WamStartup(can::Bus& bus, const Config& config);

  // Steps of `connect`, in their order; each leads to the next.
  void enumerate(int node);
  void note_found(int node);
  void check_board();
  void reset_limits(std::size_t limit);
  void wait_for_idle();
  void check_pucks();
  void wake_pucks();
  void check_awake(std::size_t motor);
  void check_wrist();
  void read_puck(std::size_t motor);
  void finish_connect();
  // Of `zero`.
  void write_home();
  void check_home(std::size_t motor);
  void guard_first_reading();

  void ask_puck(std::size_t motor, Property property, std::function<void(std::int32_t)> then);
  void ask_board(Property property, std::function<void(std::int32_t)> then);
  void tell_board(Property property, std::int32_t value);
  int board_number(Property property) const;
  std::optional<int> puck_number(std::size_t motor, Property property) const;
  double home_in_counts(std::size_t motor) const;
  Node& node_of(std::size_t motor) { return nodes_[motor + 1]; }
  std::string found_nodes() const;
  bool right_nodes() const;
  bool same_numbers();
  void fail(const std::string& message, const std::string& hint);

  const Config config_;
  const std::string bus_name_;
  Conversation talk_;
  WamProgress progress_ = WamProgress::kDone;
  base::Time now_{};
  base::Time idle_since_{};
  std::array<Node, kLastNode + 1> nodes_{};
  std::optional<BoardMode> board_mode_;
  bool woken_ = false;  ///< a puck was, and has not been told its home position since
  WamRecord record_;
  base::Diagnostics diagnostics_;
};

}  // namespace armature::wam
