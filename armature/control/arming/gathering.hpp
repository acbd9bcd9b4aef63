// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "armature/base/result.hpp"

namespace armature::control {

/// Gathers what N members answer in a round, value by value, and says when all is there; who does
/// not answer is counted, and the round after goes on without it (paper 1, sections 3.2 and 3.3.2:
/// SensorNMux and ControllerNPID).
///
/// A round lasts from one begin() to the next. A member has answered when all its values came.
/// Who has not by the end of a round is missing in it, and is not waited for in the next: there its
/// place holds the last values that it answered completely, whatever comes from it meanwhile. So
/// the late answer of round k never stands for that of round k + 1. What came in that time counts
/// as a sign of life, and from the round after the member is waited for again. Who is late in
/// every round, always by one, cannot be told from who is in time: answers that may be so late
/// need a number, which whoever asks for them has to compare.
///
/// Nothing is held for a member that never answered: it is waited for until it does. One thread
/// uses it.
class Gathering {
 public:
  static constexpr std::size_t kNobody = static_cast<std::size_t>(-1);

  /// How many members there are, and what each gives.
  struct Config {
    std::size_t members = 0;      ///< >= 1
    std::size_t values_each = 1;  ///< >= 1
    int max_missing = 3;          ///< rounds in a row that a member may be missing, less one; >= 1
  };

  /// What begin() found about the round before, and how the new one stands.
  struct Round {
    std::size_t missing = 0;        ///< how many members were missing
    std::size_t overdue = kNobody;  ///< the first that was missing `max_missing` times in a row
    bool complete = false;          ///< nobody is waited for: values() are those of this round
  };

  /// An error names every field that is wrong, and what it should be.
  static base::Result<void> check(const Config& config);
  static base::Result<Gathering> make(const Config& config);

  /// Ends the round before, if there was one, and begins the next.
  /// @rt nonblocking, no allocation, O(members)
  Round begin();

  /// One value arrived. Of several for one place in a round the last counts; before the first
  /// round none does.
  /// @param place  which of the member's values, < values_each
  /// @return true if it was the last that the round waited for: values() are those of this round
  /// @rt nonblocking, no allocation; O(1), O(members) where it completes the round
  bool add(std::size_t member, double value, std::size_t place = 0) {
    const std::size_t index = place * members_.size() + member;
    arriving_[index] = value;
    if (arrived_in_[index] == round_) return false;
    arrived_in_[index] = round_;
    --members_[member].outstanding;
    if (members_[member].held || --awaited_ != 0) return false;
    publish();
    return true;
  }

  /// Forgets everything, the counts too: what came before means nothing any more.
  /// @rt nonblocking, no allocation, O(members)
  void reset();

  /// Of the last complete round, 0 before the first; value p of member m is at p * members() + m.
  const std::vector<double>& values() const { return values_; }

  std::size_t members() const { return members_.size(); }
  bool missing_last(std::size_t member) const { return members_[member].missing_in_row > 0; }
  int missing_in_row(std::size_t member) const { return members_[member].missing_in_row; }
  /// Rounds since the last reset in which it was missing.
  int missing_ever(std::size_t member) const { return members_[member].missing_ever; }
  /// It is not waited for in this round.
  bool held(std::size_t member) const { return members_[member].held; }

 private:
  struct Member {
    std::size_t outstanding = 0;  ///< values that have not come in this round
    int missing_in_row = 0;
    int missing_ever = 0;
    bool answered = false;  ///< at least once: there is something to hold
    bool held = false;
  };

  explicit Gathering(const Config& config);

  void judge(std::size_t index, Round& round);
  void publish();
  void publish(std::size_t member);
  void wait_for_all_but_held();

  Config config_;
  std::uint64_t round_ = 0;
  std::size_t awaited_ = 0;  ///< values that this round waits for
  bool any_held_ = false;
  std::vector<Member> members_;
  std::vector<std::uint64_t> arrived_in_;  ///< the round in which each value came last
  std::vector<double> arriving_;
  std::vector<double> values_;
};

}  // namespace armature::control
