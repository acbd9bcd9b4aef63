// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "armature/exec/act.hpp"
#include "armature/exec/application_options.hpp"
#include "armature/exec/internal/application/clock.hpp"
#include "armature/exec/internal/application/ticket_pool.hpp"

namespace armature::exec::internal {

/// Tells of acts: when each is done, and between which turns of threads.
/// @thread the controlling one
class Journal {
 public:
  Journal(const ApplicationOptions& options, const Clock& clock, TicketPool& tickets)
      : options_(options), clock_(clock), tickets_(tickets) {}

  void begin_anew();
  void count_turn() { ++turns_; }
  /// That threads took in simulated time.
  std::uint64_t turns() const { return turns_; }
  /// Tools are being attended to.
  void set_attending(bool attending) { attending_ = attending; }

  /// @param act  without its time, turn and number
  /// @return its number, if it begins a command; 0 if nobody keeps the journal
  std::uint32_t note(Act act);
  /// Of the act that was told last, by their order; 0 if nobody keeps the journal.
  std::uint64_t last() const { return told_; }
  /// The act was refused.
  void note_refused(std::uint64_t act, std::string why);
  /// The thread of its component has done it, at a time of its own; told in real time only.
  void note_done(std::uint64_t act, base::Time when);
  /// Commands are cancelled by their handles, which know no application: what was cancelled since
  /// the last look comes before whatever is done next.
  void note_cancelled();

 private:
  void tell(Act act);

  const ApplicationOptions& options_;
  const Clock& clock_;
  TicketPool& tickets_;
  std::uint64_t turns_ = 0;
  std::uint64_t told_ = 0;
  std::uint32_t commands_ = 0;
  bool attending_ = false;
};

}  // namespace armature::exec::internal
