// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "armature/base/time.hpp"
#include "armature/can/frame.hpp"
#include "robots/wam/driver/wam_record.hpp"
#include "robots/wam/protocol/puck_protocol.hpp"

namespace armature::wam {

/// What pucks tell of their own state, besides their positions.
enum class PuckReading : std::uint8_t {
  kTemperature,       ///< TEMP [°C], of the puck
  kMotorTemperature,  ///< THERM [°C], of the motor
  kCurrent,           ///< IMOTOR, in the puck's own units
};
constexpr std::size_t kPuckReadings = 3;

/// Asks the pucks for these slowly, one puck for one reading at a time: first all for the first,
/// then all for the next. Nonblocking, and allocates nothing.
class PuckWatch {
 public:
  struct Config {
    base::Duration period{};  ///< between two questions; 0: nothing is asked
    base::Duration answer_timeout = std::chrono::milliseconds(10);
  };
  struct Counters {
    std::uint64_t asked = 0;
    std::uint64_t missed = 0;      ///< questions without an answer
    std::uint64_t unexpected = 0;  ///< answers that nothing had asked for, or too late

    friend bool operator==(const Counters&, const Counters&) = default;
  };

  explicit PuckWatch(const WamRecord& arm);

  /// Nothing is known. @param config  from now on
  void start(base::Time now, const Config& config);
  /// What to ask now, if anything; one question waits at a time.
  std::optional<can::Frame> question(base::Time now);
  /// What was asked last did not get on its way.
  void take_back();
  /// A frame from a puck to the host.
  /// @return whether it was the answer that was waited for
  bool take(int node, const can::Frame& frame);

  /// How often all pucks have told `reading`, each in its turn; a puck that did not answer ends
  /// the round without one.
  std::uint64_t rounds(PuckReading reading) const { return of(reading).rounds; }
  /// One number for each puck, as the last whole round had them.
  std::span<const std::int32_t> values(PuckReading reading) const {
    return std::span(of(reading).told).first(motors_);
  }
  const Counters& counters() const { return counters_; }

 private:
  /// Of all pucks; the property's number is -1 where a puck's firmware has none.
  struct Round {
    std::array<int, kMostMotors> numbers{};
    std::array<std::int32_t, kMostMotors> coming{};
    std::array<std::int32_t, kMostMotors> told{};
    std::size_t answers = 0;  ///< of the round that is under way
    std::uint64_t rounds = 0;
  };

  const Round& of(PuckReading reading) const { return all_[static_cast<std::size_t>(reading)]; }
  void go_on();

  std::size_t motors_;
  Config config_;
  std::array<Round, kPuckReadings> all_{};
  std::size_t reading_ = 0;  ///< that is asked for
  std::size_t motor_ = 0;    ///< that is asked
  bool waits_ = false;
  base::Time due_{};
  base::Time deadline_{};
  Counters counters_;
};

}  // namespace armature::wam
