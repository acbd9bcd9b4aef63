// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <cstdint>

#include "armature/base/diagnostic.hpp"
#include "armature/base/time.hpp"
#include "armature/can/virtual_bus.hpp"
#include "robots/wam/emulator/property_store.hpp"
#include "robots/wam/emulator/puck.hpp"
#include "robots/wam/protocol/pendant_word.hpp"
#include "robots/wam/protocol/puck_protocol.hpp"
#include "robots/wam/tip_speed.hpp"

namespace armature::wam {

/// The emulated safety board with its pendant, as PROTOCOL.md has it: gives the pucks power, sets
/// their modes, and supervises what it hears. A station of a virtual bus, always with power.
///
/// All of it happens in the thread that advances the bus: frames at their arrival, keys when they
/// are called, the rest in `run_timers`, which has to be called when the bus has come to
/// `next_deadline()`. It allocates nothing but in `switch_on`.
class SafetyBoard {
 public:
  struct Config {
    int version = 200;
    /// Without positions or torques for so long there is a fault, once the arm was active.
    base::Duration heartbeat_timeout = std::chrono::milliseconds(100);
    /// A velocity that is still too high so long after its fault leads to E-stop.
    base::Duration overspeed_time = std::chrono::milliseconds(500);
    base::Duration reply_delay = std::chrono::microseconds(75);
    /// How long PEN tells that a key is pressed.
    base::Duration key_time = std::chrono::milliseconds(100);
    Width broadcasts = Width::kFour;  ///< of the motor modes
    ReplyWidth replies = ReplyWidth::kByType;
    std::array<std::int32_t, TipSpeed::kMotors> counts_per_turn{4096, 4096, 4096, 4096};
  };
  struct Counters {
    std::uint64_t refused = 0;   ///< SETs of MODE that it may not follow
    std::uint64_t ignored = 0;   ///< frames for it that it does not understand
    std::uint64_t not_sent = 0;  ///< frames that the bus did not take
  };

  /// With the E-stop button pressed.
  /// @param bus  outlives it
  SafetyBoard(const Config& config, can::VirtualBus& bus);
  SafetyBoard(const SafetyBoard&) = delete;
  SafetyBoard& operator=(const SafetyBoard&) = delete;

  /// Joins the bus.
  /// @return false after an error of the bus, named in `diagnostics`
  bool switch_on(base::Diagnostics& diagnostics);

  // The pendant's keys, and its button.
  void estop();
  /// Pulls the button out; nothing else happens.
  void reset() { button_pressed_ = false; }
  /// From E-stop if the button is out, from active, or to clear faults.
  void shift_idle();
  /// From idle unless there is a fault.
  void shift_activate();

  // Faults on demand.
  /// As if the monitor had found one.
  void fail(Monitor monitor);
  /// Of the motors' supply; 48 at first. Beyond its limits there is a fault.
  void set_supply(double volts);
  /// The next `count` answers are not sent.
  void lose_replies(int count) { replies_to_lose_ = count; }
  /// Answers come later by this; 0 ends it.
  void delay_replies(base::Duration by) { late_by_ = by; }
  /// It neither hears nor is heard, and does not know it.
  void set_dead(bool dead) { station_.set_dead(dead); }

  BoardMode mode() const { return static_cast<BoardMode>(store_.get(Property::kMode)); }
  /// Whether the pucks have power.
  bool power() const { return mode() != BoardMode::kEstop; }
  bool zeroed() const { return store_.get(Property::kZero) == 1; }
  PendantWord pendant() const;
  const PropertyStore& properties() const { return store_; }
  const Counters& counters() const { return counters_; }
  can::VirtualStation& station() { return station_; }

  /// @rt nonblocking, no allocation
  base::Time next_deadline() const;
  /// @rt nonblocking, no allocation
  void run_timers();

 private:
  void take_news();
  void take(const can::Frame& frame);
  void take_message(const Message& message);
  void set(Property property, std::int32_t value);
  void set_mode(std::int32_t mode);

  // Supervision.
  void take_positions(int node, const can::Frame& frame);
  void take_torques(const Torques& torques);
  void judge_speed(double speed);
  void judge_supply();
  void feed_heartbeat() { fed_ = bus_.now(); }
  void trip(Monitor monitor);
  void warn(Monitor monitor, bool warned);
  Level& level(Monitor monitor) { return levels_[static_cast<std::size_t>(monitor)]; }
  bool has_fault() const;

  void enter_estop();
  void enter_idle();
  void enter_active();
  void tell_motor_modes(PuckMode mode);
  void press(PendantKey key);
  void answer(Property property);
  void send(const can::Frame& frame, base::Time at);

  const Config config_;
  can::VirtualBus& bus_;
  can::VirtualStation& station_;
  PropertyStore store_;
  TipSpeed tip_speed_;
  Counters counters_;

  std::array<Level, kMonitors> levels_{};
  bool button_pressed_ = true;
  double supply_ = 48.0;
  PendantKey key_ = PendantKey::kNone;
  base::Time key_until_ = base::Time::max();
  bool armed_ = false;  ///< the heartbeat is missed if it fails
  base::Time fed_{};
  bool overspeed_ = false;
  base::Time overspeed_until_ = base::Time::max();

  int replies_to_lose_ = 0;
  base::Duration late_by_{};
};

}  // namespace armature::wam
