// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"
#include "armature/can/bus.hpp"
#include "armature/types/enum.hpp"
#include "robots/janus/aic/aic_protocol.hpp"

namespace armature::janus {

enum class AicMode {
  kSequential,   ///< a request and its answer, card after card; a motor frame for each
  kSynchronous,  ///< one SYNC, the answers back to back; a motor frame for four cards
};
ARMATURE_ENUM(AicMode, kSequential, kSynchronous);

/// How a reading of all sensors stands.
enum class AicReading {
  kNone,        ///< none was begun
  kWaiting,     ///< for answers: poll again when a frame has come, or at the deadline
  kComplete,    ///< all cards have answered
  kIncomplete,  ///< some have not; `AicCard::fresh` says which have
  kNoBus,       ///< the bus is off or down
};

/// What went wrong with one card; nothing is lost without being counted here.
struct AicCounters {
  std::uint64_t lost_answers = 0;  ///< readings that ended without its report
  std::uint64_t late_answers = 0;  ///< reports that came when none was waited for
  std::uint64_t lost_reports = 0;  ///< made by the card, but not received: their counts are gone
  std::uint64_t repeated = 0;      ///< reports that came twice
  std::uint64_t restarts = 0;      ///< of the card
  std::uint64_t malformed = 0;     ///< frames of a wrong length, or with an unknown code
  std::uint64_t unexpected = 0;    ///< frames to the card from elsewhere: another host is there
  std::uint64_t not_sent = 0;      ///< frames that the bus did not take
  std::uint64_t not_finite = 0;    ///< motor values that were no numbers; 0 is sent instead
  std::uint64_t emergencies = 0;

  friend bool operator==(const AicCounters&, const AicCounters&) = default;
};

/// What is known of one card.
struct AicCard {
  int number = 0;
  /// Counts of the encoder since the first report. That one says from where on it counts, since
  /// what moved before concerned nobody.
  std::int64_t counts = 0;
  /// Whether `counts` has all of them: false before the first report, and from the loss of a report
  /// or a restart of the card until `accept_counts`.
  bool counts_exact = false;
  bool reported = false;  ///< there was a report
  bool fresh = false;     ///< it answered in the reading that was begun last
  SensorReport report;    ///< the last one
  base::Time report_time{};
  std::optional<Heartbeat> heartbeat;  ///< the last one
  std::optional<Emergency> emergency;  ///< the last one, until `forget_emergency`
  base::Time heard{};                  ///< when its last valid frame came
  bool restarted = false;              ///< it said so, and has not reported since
  AicCounters counters;
};

/// What concerns no card that the driver has.
struct AicBusCounters {
  std::uint64_t unknown_frames = 0;  ///< with identifiers that the protocol or the driver has not
  std::uint64_t error_frames = 0;
  std::uint64_t not_sent = 0;  ///< frames for all cards or four that the bus did not take
  std::uint64_t bus_lost = 0;  ///< how often the bus was found to be off or down

  friend bool operator==(const AicBusCounters&, const AicBusCounters&) = default;
};

/// The host's side of AIC cards on one CAN bus: frames to meaning and back. A cycle is
///
///     driver.begin_reading(now);
///     while (driver.poll(now) == AicReading::kWaiting) { /* sleep until news or the deadline */ }
///     driver.set_motor(0, 0.5);
///     driver.send_motors();
///
/// Cards are named by their index in the configuration. The driver neither opens nor closes the
/// bus. It commands nothing on its own account: when the bus has gone, all motor values are 0 until
/// they are set again.
///
/// Every function but `make` and `bus_options` is nonblocking and allocates nothing. One thread
/// uses the driver; it is the bus's sender and receiver.
class AicDriver {
 public:
  struct Config {
    std::vector<int> cards;  ///< their numbers: different, 1 to kMostCards
    AicMode mode = AicMode::kSequential;
    /// How long to wait for an answer, counted from the request or from the answer before it; > 0.
    base::Duration answer_timeout = std::chrono::milliseconds(1);
    /// A card that is not heard for so long is silent; > its heartbeat's period.
    base::Duration silence_timeout = std::chrono::milliseconds(250);
  };

  /// @param bus  outlives the driver
  /// An error names what is wrong in the configuration.
  static base::Result<AicDriver> make(can::Bus& bus, const Config& config);
  /// How to open a bus for these cards: with room for their frames, and without those of others.
  static can::BusOptions bus_options(const Config& config);

  /// Begins anew: no reading, all motor values 0; cards have to be heard from now on. To be called
  /// when the bus was opened.
  void start(base::Time now);

  /// Asks for the sensors: of the first card, or of all at once. What came since the last reading
  /// is taken first. A reading that still waits is given up. Asks a bus that is off to come back.
  /// @return kWaiting; kNoBus; kIncomplete if the bus takes no frame now
  AicReading begin_reading(base::Time now);
  /// Takes what has come, asks the next card, gives up one that does not answer in time.
  AicReading poll(base::Time now);
  AicReading reading() const { return reading_; }
  /// When the card that is waited for will be given up.
  base::Time deadline() const { return deadline_; }

  /// @param share  of the supply; limited to -1 to 1. Sent by `send_motors`
  void set_motor(std::size_t index, double share);
  /// A frame for each card or for four of them, as the mode has it. Cards of a group that the
  /// driver has not get 0.
  /// @return kSent, or why the first frame was not taken that was not
  can::SendStatus send_motors();

  /// Other than kWatchdog.
  can::SendStatus command(std::size_t index, AicCommand command);
  /// @param time  1 to 65535 ms, in whole milliseconds; others are kInvalid
  can::SendStatus set_watchdog(std::size_t index, base::Duration time);

  std::size_t cards() const { return cards_.size(); }
  const AicCard& card(std::size_t index) const { return cards_[index]; }
  bool silent(std::size_t index, base::Time now) const;
  /// `counts` is what somebody else has found to be true.
  void accept_counts(std::size_t index, std::int64_t counts);
  void forget_emergency(std::size_t index) { cards_[index].emergency.reset(); }

  can::BusState bus_state() const { return bus_->state(); }
  const AicBusCounters& bus_counters() const { return bus_counters_; }

 private:
  AicDriver(can::Bus& bus, const Config& config);

  bool bus_was_lost() const;
  AicReading lose_bus();
  void clear_motors();

  // Asking and waiting.
  void ask_all(base::Time now);
  void ask_cards_from(std::size_t index, base::Time now);
  void go_on(base::Time now);
  void give_up(base::Time now);
  void finish();
  bool all_fresh() const;

  // Frames.
  void take_frames();
  void take(const can::Arrival& arrival);
  void take_from(AicCard& card, AicFunction function, const can::Arrival& arrival);
  void take_sensor(AicCard& card, const SensorReport& report, base::Time time);
  void answer(AicCard& card, base::Time time);
  can::SendStatus send(const can::Frame& frame, std::uint64_t& not_sent);
  can::SendStatus send_groups();

  can::Bus* bus_;
  AicMode mode_;
  base::Duration answer_timeout_;
  base::Duration silence_timeout_;
  std::vector<AicCard> cards_;
  std::vector<std::int16_t> motors_;
  std::vector<std::size_t> index_of_;  ///< by the card's number; cards_.size(): not one of these
  std::vector<int> groups_;            ///< that these cards are in

  AicReading reading_ = AicReading::kNone;
  base::Time deadline_ = base::Time::max();
  std::size_t asked_ = 0;  ///< the card that is waited for, in sequential mode
  std::uint8_t sync_counter_ = 0;
  std::uint64_t bus_offs_seen_ = 0;
  AicBusCounters bus_counters_;
};

}  // namespace armature::janus
