// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/can/bus.hpp"
#include "armature/can/frame.hpp"
#include "armature/can/virtual_station.hpp"

namespace armature::can {

/// What became of a frame on the wire.
enum class Outcome {
  kGood,
  kCorrupted,          ///< ended by an error frame; sent again
  kNoAcknowledgement,  ///< nobody else is there; sent again
  kLost,               ///< acknowledged, but received by nobody: an injected fault
  kAborted,            ///< its sender went off in the middle of it
};

/// A frame that was on the wire; `end` is when another may begin.
struct WireEvent {
  Frame frame;
  base::Time begin{};
  base::Time end{};
  Outcome outcome = Outcome::kGood;
  const VirtualStation* sender = nullptr;
};

/// How many transmissions on the wire had each outcome.
struct WireCounters {
  std::uint64_t good = 0;
  std::uint64_t corrupted = 0;
  std::uint64_t not_acknowledged = 0;
  std::uint64_t lost = 0;
  std::uint64_t aborted = 0;
  /// Two stations sent the same identifier at once, which the rules of CAN forbid. On a real bus
  /// both frames would be destroyed; here the station that was added first wins.
  std::uint64_t collisions = 0;
  base::Duration busy{};  ///< the wire was not idle
};

/// A CAN bus inside this process. One frame at a time is on the wire, as long as it would be there
/// to the bit; of several that wait, the most urgent goes first; all stations receive it at its end
/// (with the three bits after which the next may begin).
///
/// Time passes only in `advance_to`, so in simulated time two equal runs are equal to the bit; in
/// real time some thread calls it with the time that it is. What is sent at one time competes for
/// the bus at that time, in whatever order it was sent.
class VirtualBus {
 public:
  using Clock = std::function<base::Time()>;

  /// @param bit_rate  bits per second, > 0
  /// @param clock     the time that it is; asked when a frame is sent. Must not wait
  VirtualBus(std::string name, std::uint32_t bit_rate, Clock clock);
  VirtualBus(const VirtualBus&) = delete;
  VirtualBus& operator=(const VirtualBus&) = delete;
  ~VirtualBus();

  const std::string& name() const { return name_; }
  std::uint32_t bit_rate() const { return bit_rate_; }

  /// Another station, closed. Lives as long as the bus; its name begins with the bus's.
  VirtualStation& add_station(const std::string& name, SendOrder order = SendOrder::kFirst);

  /// Everything that happens up to and including `until`: frames end and are received, `on_news`
  /// and the tap are called, what is sent from there competes at the time of the event. A frame
  /// that would begin at `until` does not begin yet.
  /// @rt nonblocking, no allocation, if `on_news` and the tap are; O(events x frames that wait)
  /// @thread always the same, and the only one for all of this class
  void advance_to(base::Time until);

  /// How far the bus has been advanced; within `on_news` and the tap the time of the event.
  base::Time now() const { return now_; }

  /// When something will happen if nobody sends anything more; none: nothing ever.
  /// @rt nonblocking, no allocation
  std::optional<base::Time> next_event();

  /// Called with every frame at its end, before it is received.
  void set_tap(std::function<void(const WireEvent&)> tap) { tap_ = std::move(tap); }
  WireCounters counters() const { return counters_; }

  /// The next `count` frames (of those that `which` lets through) are received by nobody although
  /// they are acknowledged; each station that should have had one counts it as lost.
  void lose_next(std::uint64_t count, std::optional<Filter> which = std::nullopt);
  /// The next `count` are destroyed in their last bit before the CRC delimiter, and so sent again.
  void corrupt_next(std::uint64_t count, std::optional<Filter> which = std::nullopt);
  /// While the bus is cut, nobody hears or acknowledges anybody.
  void set_cut(bool cut) { cut_ = cut; }

 private:
  friend class VirtualStation;

  struct Fault {
    std::uint64_t count;
    std::optional<Filter> which;
    Outcome outcome;
  };
  struct Transmission {
    VirtualStation* sender;
    std::uint64_t number;
    WireEvent event;
  };

  base::Time time_of_sending() const;
  void collect();
  bool step(base::Time until);
  base::Time earliest_start() const;
  VirtualStation* next_recovery();
  Transmission plan(base::Time begin);
  Fault* fault_for(const Frame& frame);
  bool acknowledged(const VirtualStation& sender) const;
  bool destroyed(const VirtualStation& sender) const;
  base::Duration duration(const Frame& frame, Outcome outcome) const;
  void begin(base::Time at);
  void finish();
  void end_good(const Transmission& done);
  void end_with_error(const Transmission& done);
  void hear_noise(VirtualStation& station, base::Time end);
  void count(const WireEvent& event);

  const std::string name_;
  const std::uint32_t bit_rate_;
  const Clock clock_;
  std::vector<std::unique_ptr<VirtualStation>> stations_;
  std::function<void(const WireEvent&)> tap_;
  std::vector<Fault> faults_;
  bool cut_ = false;
  base::Time now_{};
  base::Time idle_since_{};
  std::optional<Transmission> on_wire_;
  WireCounters counters_;
};

}  // namespace armature::can
