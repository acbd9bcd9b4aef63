// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "armature/base/diagnostic.hpp"
#include "armature/base/time.hpp"
#include "armature/can/virtual_bus.hpp"
#include "robots/janus/aic/aic_protocol.hpp"
#include "robots/janus/aic/aic_report_book.hpp"
#include "robots/janus/aic/aic_wiring.hpp"

namespace armature::janus {

/// Conditions of a card that last from `begin` to `end`.
enum class AicFault : std::uint8_t {
  kSilent,        ///< its line to the bus is broken: it neither hears nor is heard
  kEncoderStuck,  ///< counts no more, and does not notice
  kOverCurrent,   ///< the three that it notices: emergency frame, motor off, brake applied
  kEncoderError,
  kSupply,
};
constexpr std::size_t kAicFaults = 5;

/// What is wrong with a sensor frame.
enum class AicSpoil : std::uint8_t {
  kNone,
  kWrongLength,      ///< the last byte is missing
  kWrongCounter,     ///< five reports further than it should be
  kWrongIdentifier,  ///< that of the next card
  kTwice,            ///< sent a second time
};

/// An emulated AIC card: what its firmware does, frame by frame as PROTOCOL.md has it, as a station
/// of a virtual bus. The host cannot tell it from a real one.
///
/// All of it happens in the thread that advances the bus: frames at their arrival, the rest in
/// `run_timers`, which has to be called when the bus has come to `next_deadline()`. It reads no
/// clock of its own, and allocates nothing but in `power_on`.
class AicFirmware {
 public:
  struct Counters {
    std::uint64_t reports = 0;      ///< sensor frames that were handed to the bus
    std::uint64_t ignored = 0;      ///< frames, not for others, with a wrong length, kind or code
    std::uint64_t refused = 0;      ///< commands that its state does not allow
    std::uint64_t not_sent = 0;     ///< frames that the bus did not take
    std::uint64_t emergencies = 0;  ///< times it switched off by itself
  };

  /// A card without power.
  /// @param card    its number, 1 to kMostCards
  /// @param bus     outlives it, as does `wiring`
  AicFirmware(int card, can::VirtualBus& bus, AicWiring& wiring);
  AicFirmware(const AicFirmware&) = delete;
  AicFirmware& operator=(const AicFirmware&) = delete;

  /// The firmware starts: off, brake applied, encoder at 0; a heartbeat says so.
  /// @return false after an error of the bus, named in `diagnostics`
  bool power_on(base::Diagnostics& diagnostics);
  /// Motor off, brake applied, nothing is heard or sent, everything is forgotten.
  void power_off();

  /// The time of the next heartbeat or of the watchdog; the end of time without power. Any frame
  /// may change it.
  /// @rt nonblocking, no allocation
  base::Time next_deadline() const;
  /// Does what is due at the bus's time.
  /// @rt nonblocking, no allocation
  void run_timers();

  void begin(AicFault fault);
  void end(AicFault fault);
  /// The next `count` sensor frames are wrong.
  void spoil_next(AicSpoil how, int count = 1);
  /// Answers come later by this; 0 ends it.
  void delay_answers(base::Duration by) { delay_ = by; }

  int card() const { return card_; }
  AicState state() const { return state_; }
  bool brake_released() const { return brake_released_; }
  const Counters& counters() const { return counters_; }
  /// Its controller on the bus, for faults of that.
  can::VirtualStation& station() { return station_; }

 private:
  // Frames.
  void take_news();
  void take(const can::Frame& frame);
  void take_command(const can::Frame& frame);
  void execute(AicCommand command, const can::Frame& frame);
  void take_motor(const can::Frame& frame);
  void take_motor_group(const can::Frame& frame);
  void drive(std::int16_t value);
  void ignore() { ++counters_.ignored; }
  void refuse() { ++counters_.refused; }

  // Reports.
  void report();
  void collect_counts();
  SensorReport latch();
  void send_spoiled(const SensorReport& report);
  void send_report(const can::Frame& frame, std::int32_t counts);
  void acknowledge(const can::Frame& own);
  void come_back_from_bus_off();

  // States.
  void switch_on();
  void switch_off();
  void acknowledge_trip();
  void apply_brake();
  void release_brake();
  void trip(AicEmergency why, AicState state);
  bool tripped() const { return state_ == AicState::kWatchdog || state_ == AicState::kFault; }
  bool supervised() const { return state_ == AicState::kOn || brake_released_; }
  void feed_watchdog() { fed_ = bus_.now(); }
  bool lasts(AicFault fault) const { return faults_[static_cast<std::size_t>(fault)]; }
  void trip_for(AicFault fault);
  void trip_for_lasting_faults();

  base::Time answer_time() const { return bus_.now() + kProcessingTime + delay_; }
  void send_heartbeat(base::Time at);
  bool send(const can::Frame& frame, base::Time at);

  const int card_;
  can::VirtualBus& bus_;
  AicWiring& wiring_;
  can::VirtualStation& station_;
  Counters counters_;

  // From power-up on.
  bool powered_ = false;
  AicState state_ = AicState::kStarted;
  bool brake_released_ = false;
  base::Time started_{};
  base::Time next_heartbeat_{};
  base::Time fed_{};
  base::Duration watchdog_ = kDefaultWatchdog;
  AicReportBook book_;
  bool heartbeat_waits_ = false;

  // Injected.
  std::array<bool, kAicFaults> faults_{};
  AicSpoil spoil_ = AicSpoil::kNone;
  int spoil_left_ = 0;
  base::Duration delay_{};
};

}  // namespace armature::janus
