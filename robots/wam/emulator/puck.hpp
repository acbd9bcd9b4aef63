// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "armature/base/diagnostic.hpp"
#include "armature/base/time.hpp"
#include "armature/can/virtual_bus.hpp"
#include "robots/wam/emulator/motors.hpp"
#include "robots/wam/emulator/property_store.hpp"
#include "robots/wam/protocol/puck_protocol.hpp"

namespace armature::wam {

/// How many bytes answers have.
enum class ReplyWidth {
  kByType,     ///< four or six, as the property's value has 16 or 32 bits
  kAlwaysSix,  ///< also allowed
};

/// What is wrong with an answer.
enum class ReplySpoil : std::uint8_t {
  kNone,
  kWrongProperty,  ///< the number of the next one
  kWrongLength,    ///< the last byte is missing
  kSecondByte,     ///< is not 0
  kTwice,          ///< sent a second time
};

/// What a puck does at the moment.
enum class PuckState : std::uint8_t {
  kOff,      ///< without power
  kBooting,  ///< with power, and silent
  kMonitor,  ///< STAT 0: the boot monitor alone
  kWaking,   ///< silent on its way to the main firmware
  kReady,    ///< STAT 2
};

/// An emulated motor puck: what its firmware does, frame by frame as PROTOCOL.md has it, as a
/// station of a virtual bus. The host cannot tell it from a real one.
///
/// All of it happens in the thread that advances the bus: frames at their arrival, the rest in
/// `run_timers`, which has to be called when the bus has come to `next_deadline()`. It reads no
/// clock of its own, and allocates nothing but when it joins the bus, after power-up and waking.
class Puck {
 public:
  struct Config {
    int node = 1;
    int version = 175;         ///< of the main firmware: which properties it has, by what numbers
    int monitor_version = 12;  ///< VERS while the monitor runs
    std::optional<int> told_version{};  ///< VERS says this instead of `version`
    int role = kAbsoluteEncoder;
    std::int32_t counts_per_turn = 4096;
    std::int32_t units_per_nm = 2700;  ///< IPNM, and what is true of the motor
    std::int32_t most_torque = 4860;   ///< MT, puck units
    int slot = 1;                      ///< PIDX: its place in torque frames, 1 to 4
    std::array<int, 3> groups{0, 1, 4};
    int poles = 12;
    int temperature = 30;        ///< TEMP [degrees Celsius]
    int motor_temperature = 35;  ///< THERM [degrees Celsius]
    double mech_zero = 0.0;      ///< [rad] the motor's angle at which MECH is 0
    base::Duration boot_time = std::chrono::milliseconds(300);  ///< from power to the monitor
    base::Duration wake_time = std::chrono::milliseconds(500);  ///< from there to STAT 2, < 1 s
    base::Duration reply_delay = std::chrono::microseconds(75);
    PositionFlags position_flags = PositionFlags::kUpper;
    ReplyWidth replies = ReplyWidth::kByType;
  };
  /// As the maker delivers node 1 to 7.
  static Config standard(int node, int version = 175);

  struct Counters {
    std::uint64_t answers = 0;   ///< frames that were handed to the bus
    std::uint64_t ignored = 0;   ///< frames for it that it does not understand
    std::uint64_t not_sent = 0;  ///< frames that the bus did not take
    std::uint64_t lost = 0;      ///< answers that `lose_replies` kept back
  };

  /// A puck without power.
  /// @param motor   its motor's number there
  /// @param motors  outlives it, as does `bus`
  Puck(const Config& config, can::VirtualBus& bus, Motors& motors, std::size_t motor);
  Puck(const Puck&) = delete;
  Puck& operator=(const Puck&) = delete;

  /// Power comes or goes; it joins or leaves the bus in `run_timers`.
  void set_power(bool on);

  /// @rt nonblocking, no allocation
  base::Time next_deadline() const;
  /// Does what is due at the bus's time.
  void run_timers();

  // Faults on demand.
  /// It neither hears nor is heard, and does not know it; its motor goes on as it was told last.
  void set_dead(bool dead) { station_.set_dead(dead); }
  /// The next `count` answers are not sent.
  void lose_replies(int count) { replies_to_lose_ = count; }
  void spoil_replies(ReplySpoil how, int count = 1);
  /// Answers come later by this; 0 ends it.
  void delay_replies(base::Duration by) { late_by_ = by; }
  /// [degrees Celsius] from now on
  void set_temperatures(int puck, int motor) {
    store_.set(Property::kTemp, puck);
    store_.set(Property::kTherm, motor);
  }
  /// It says that it has this firmware; its properties keep their numbers.
  void tell_version(int version) { store_.set_default(Property::kVers, version); }

  int node() const { return config_.node; }
  PuckState state() const { return state_; }
  PuckMode mode() const { return static_cast<PuckMode>(store_.get(Property::kMode)); }
  /// P now.
  std::int32_t counts() const { return static_cast<std::int32_t>(encoder() + offset_); }
  /// What its motor is told, puck units.
  std::int32_t torque() const { return store_.get(Property::kT); }
  const PropertyStore& properties() const { return store_; }
  const Counters& counters() const { return counters_; }
  /// Its controller on the bus, for faults of that.
  can::VirtualStation& station() { return station_; }

 private:
  bool on_bus() const { return state_ == PuckState::kMonitor || state_ == PuckState::kReady; }
  void join_bus();
  void boot();
  void start_main();
  void return_to_monitor();

  void take_news();
  void take(const can::Frame& frame);
  bool is_for_me(const Address& address) const;
  void ignore() { ++counters_.ignored; }

  void get(int number);
  void get_in_monitor(int number);
  void set(const Message& message);
  void set_in_monitor(const Message& message);
  void set_property(Property property, std::int32_t value);
  void set_mode(std::int32_t mode);
  void set_torque(std::int32_t units);
  std::int32_t value(Property property) const;

  std::int32_t encoder() const;
  std::int32_t mech() const;
  Positions positions() const;
  void answer(can::Frame frame);
  void reply(int number, std::int32_t value, Width width);
  void send(const can::Frame& frame);

  const Config config_;
  can::VirtualBus& bus_;
  Motors& motors_;
  const std::size_t motor_;
  can::VirtualStation& station_;
  PropertyStore store_;
  PropertyStore monitor_;
  Counters counters_;

  PuckState state_ = PuckState::kOff;
  base::Time due_ = base::Time::max();  ///< when booting or waking ends
  std::int64_t offset_ = 0;             ///< from the encoder's counts to P

  int replies_to_lose_ = 0;
  int replies_to_spoil_ = 0;
  ReplySpoil spoil_ = ReplySpoil::kNone;
  base::Duration late_by_{};
};

}  // namespace armature::wam
