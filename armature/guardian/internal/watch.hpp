// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace armature::guardian::internal {

constexpr std::int64_t kMillisecond = 1'000'000;
/// So many periods without a cycle are the end.
constexpr std::int64_t kMostMissedPeriods = 3;
/// How often it looks at a process whose cycles are not expected, and says that it lives.
constexpr std::int64_t kQuietLook = 50 * kMillisecond;
/// Between two sendings, once the drives are idle and the process has not said that it knows.
constexpr std::int64_t kReminder = 20 * kMillisecond;
/// It has looked late itself by more: then it was the machine that stood still, not the process.
constexpr std::int64_t kOwnLateness = kMillisecond;
/// The drives' own watchdogs wait for 100 ms. A machine that stands still again and again is not
/// waited for beyond this.
constexpr std::int64_t kMostPatience = 50 * kMillisecond;
/// How long it goes on sending to drives that do not answer, once the process is gone.
constexpr std::int64_t kMostInsistence = 30'000 * kMillisecond;

/// The same where there is no bus any more: it was that of a process that is gone, too.
constexpr std::int64_t kMostWithoutBus = 2'000 * kMillisecond;

/// What is to be seen when the guardian looks. Times are of the monotonic clock [ns].
struct Sight {
  std::int64_t now = 0;
  std::int64_t beat = 0;           ///< the process's last cycle
  bool watched = false;            ///< cycles are expected
  bool ended = false;              ///< the process has, in order
  bool dead = false;               ///< the process is
  std::uint32_t acknowledged = 0;  ///< acts of the guardian that the process knows of
  bool idle = false;               ///< all drives have said so since it acts
  bool bus = true;                 ///< there is one
};

enum class Act : std::uint32_t {
  kNothing,
  kSend,    ///< the safe frames and the questions
  kEnd,     ///< there is nothing to do any more
  kGiveUp,  ///< the same, though drives have not answered
};

enum class Cause : std::uint32_t { kNone, kNoCycle, kDeath };

/// When a guardian acts. Knows no system, so that tests have its time in their hands.
class Watch {
 public:
  explicit Watch(std::int64_t period) : period_(period) {}

  Act look(const Sight& sight);
  /// When to look next; earlier looks do no harm.
  std::int64_t next() const { return next_; }
  /// How often it has begun to act.
  std::uint32_t acted() const { return acted_; }
  /// Why it acts; kNone: it does not.
  Cause cause() const { return cause_; }
  /// How long ago the last cycle was when it began to.
  std::int64_t silence() const { return silence_; }

 private:
  Act watch(const Sight& sight, bool was_late);
  Act begin_to_act(const Sight& sight, Cause cause);
  Act go_on(const Sight& sight);
  Act look_again(std::int64_t at);

  const std::int64_t period_;
  std::int64_t next_ = 0;
  std::int64_t beat_ = 0;
  std::int64_t begun_ = 0;
  std::int64_t silence_ = 0;
  std::uint32_t acted_ = 0;
  Cause cause_ = Cause::kNone;
};

}  // namespace armature::guardian::internal
