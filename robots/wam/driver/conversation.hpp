// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/can/bus.hpp"
#include "robots/wam/protocol/puck_protocol.hpp"

namespace armature::wam {

/// What a host says to pucks and safety board one after the other, and what they answer: one
/// question at a time, asked again when no answer comes. An answer is one to the question that
/// waits if node and property are its own; anything else is counted and dropped.
///
/// Steps are added by what the steps before have led to. One thread uses it; it is the bus's sender
/// and receiver.
class Conversation {
 public:
  /// The value; none if the node did not answer.
  using Answered = std::function<void(std::optional<std::int32_t>)>;

  struct Patience {
    base::Duration window;  ///< how long to wait for an answer
    int tries;              ///< how often to ask, >= 1
  };
  struct Counters {
    std::uint64_t unexpected = 0;  ///< frames that answer nothing that was asked
    std::uint64_t repeated = 0;    ///< questions that were asked again
    std::uint64_t not_sent = 0;    ///< frames that the bus did not take
  };

  /// @param bus  outlives it
  explicit Conversation(can::Bus& bus) : bus_(&bus) {}

  /// For the value of a property, by its number there.
  void ask(int node, int number, Patience patience, Answered answered);
  /// For P, which is answered in another form.
  void ask_position(int node, int number, Patience patience, Answered answered);
  /// A frame that is not answered.
  void tell(const can::Frame& frame);
  /// Nothing is sent for so long.
  void pause(base::Duration time);
  /// What follows when all before has been said.
  void then(std::function<void()> action);

  /// Does what is due; asks a bus that is off to come back.
  /// @return whether something is left to be said or waited for
  bool poll(base::Time now);
  /// When to poll again if no frame comes before.
  base::Time deadline() const { return deadline_; }
  /// Nothing is left, and nothing waits.
  void forget();
  const Counters& counters() const { return counters_; }

 private:
  enum class Kind { kAsk, kTell, kPause, kAction };
  struct Step {
    Kind kind;
    can::Frame frame{};
    int node = 0;
    int number = 0;
    bool position = false;
    Patience patience{};
    Answered answered{};
    std::function<void()> action{};
  };

  void begin_next(base::Time now);
  void take_frames();
  std::optional<std::int32_t> answer_in(const can::Frame& frame) const;
  void send_question(base::Time now);
  void send(const can::Frame& frame);
  bool waits() const { return asking_ || pausing_; }
  void end_question(std::optional<std::int32_t> value);

  can::Bus* bus_;
  std::vector<Step> steps_;
  std::size_t next_ = 0;  ///< of the steps
  bool asking_ = false;   ///< the step before `next_` is a question that waits
  bool pausing_ = false;
  int tries_left_ = 0;
  std::optional<std::int32_t> value_;  ///< its answer
  base::Time deadline_ = base::Time::min();
  Counters counters_;
};

}  // namespace armature::wam
