// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "armature/base/time.hpp"
#include "armature/can/frame.hpp"
#include "robots/wam/protocol/pendant_word.hpp"
#include "robots/wam/protocol/puck_protocol.hpp"

namespace armature::wam {

/// Asks the safety board for MODE and, half a period later, for PEN; sooner when there is a reason.
/// Nonblocking, and allocates nothing.
class BoardWatch {
 public:
  struct Config {
    int mode_number = 0;                                            ///< of MODE
    int pendant_number = 0;                                         ///< of PEN
    base::Duration period = std::chrono::milliseconds(50);          ///< of each
    base::Duration answer_timeout = std::chrono::milliseconds(10);  ///< < period / 2
    int most_missed = 3;  ///< answers to MODE in a row, from which on the board is silent
  };
  struct Counters {
    std::uint64_t missed = 0;      ///< questions without an answer
    std::uint64_t unexpected = 0;  ///< answers that nothing had asked for, or too late
    std::uint64_t malformed = 0;   ///< a PEN or MODE that means nothing

    friend bool operator==(const Counters&, const Counters&) = default;
  };

  explicit BoardWatch(const Config& config) : config_(config) {}

  /// Nothing is known; MODE is asked for first.
  void start(base::Time now);
  /// What to ask now, if anything; to be called in every cycle. One question waits at a time.
  std::optional<can::Frame> question(base::Time now);
  /// A frame from the board to the host.
  /// @return whether it was an answer that was waited for
  bool take(const can::Frame& frame, base::Time now);
  /// What the board says to all, the modes that it sets the pucks to. These frames are inferred
  /// (PROTOCOL.md), so nothing is believed of them but that there is news: MODE is asked for at
  /// once, for that reason once in a period.
  void hear(const can::Frame& frame, base::Time now);
  /// What was asked last did not get on its way, so its answer is not missed.
  void take_back(base::Time now);

  void ask_mode_soon(base::Time now) { mode_due_ = now; }
  void ask_pendant_soon(base::Time now) { pendant_due_ = now; }

  /// As it was said last; none before it was.
  std::optional<BoardMode> mode() const { return mode_; }
  base::Time mode_time() const { return mode_time_; }  ///< when it was
  std::optional<PendantWord> pendant() const { return pendant_; }
  /// Answers to PEN until now, to see when there is a new one.
  std::uint64_t pendant_answers() const { return pendant_answers_; }
  bool silent() const { return missed_modes_ >= config_.most_missed; }
  const Counters& counters() const { return counters_; }

 private:
  enum class Asked { kNothing, kMode, kPendant };

  void give_up();

  Config config_;
  Asked asked_ = Asked::kNothing;
  base::Time deadline_{};  ///< of the answer
  base::Time mode_due_{};
  base::Time pendant_due_{};
  base::Time hears_again_ = base::Time::min();
  int missed_modes_ = 0;
  std::optional<BoardMode> mode_;
  base::Time mode_time_{};
  std::optional<PendantWord> pendant_;
  std::uint64_t pendant_answers_ = 0;
  Counters counters_;
};

}  // namespace armature::wam
