// SPDX-License-Identifier: Apache-2.0
#include "armature/can/virtual_bus.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace armature::can {
namespace {

/// An error frame: the flag of the sender, one more bit of the receivers' flags, which begin a bit
/// later, the delimiter, and the bits between frames.
constexpr int kErrorFrameBits = 6 + 1 + 8 + 3;
/// The same where nobody else raises a flag.
constexpr int kLonelyErrorFrameBits = 6 + 8 + 3;

/// The bus that the calling thread is advancing: what it sends meanwhile is sent at that bus's
/// time.
thread_local const VirtualBus* advancing = nullptr;

class AdvancingScope {
 public:
  explicit AdvancingScope(const VirtualBus& bus) : before_(std::exchange(advancing, &bus)) {}
  AdvancingScope(const AdvancingScope&) = delete;
  AdvancingScope& operator=(const AdvancingScope&) = delete;
  ~AdvancingScope() { advancing = before_; }

 private:
  const VirtualBus* const before_;
};

}  // namespace

VirtualBus::VirtualBus(std::string name, std::uint32_t bit_rate, Clock clock)
    : name_(std::move(name)), bit_rate_(bit_rate), clock_(std::move(clock)) {
  assert(bit_rate_ > 0);
}

VirtualBus::~VirtualBus() = default;

VirtualStation& VirtualBus::add_station(const std::string& name, SendOrder order) {
  stations_.push_back(std::make_unique<VirtualStation>(*this, name_ + "." + name, order));
  return *stations_.back();
}

base::Time VirtualBus::time_of_sending() const { return advancing == this ? now_ : clock_(); }

void VirtualBus::advance_to(base::Time until) {
  assert(advancing != this && "on_news and the tap must not advance the bus");
  const AdvancingScope scope(*this);
  collect();
  while (step(until)) collect();
  now_ = std::max(now_, until);
}

std::optional<base::Time> VirtualBus::next_event() {
  collect();
  if (on_wire_) return on_wire_->event.end;
  const VirtualStation* const recovering = next_recovery();
  const base::Time recovery =
      recovering != nullptr ? recovering->recovered_at(idle_since_) : base::Time::max();
  const base::Time start = earliest_start();
  if (start == base::Time::max() && recovering == nullptr) return std::nullopt;
  return start < recovery ? std::min(plan(start).event.end, recovery) : recovery;
}

void VirtualBus::collect() {
  for (const auto& station : stations_) station->collect();
}

/// Lets the next thing happen; false if nothing more does until then.
bool VirtualBus::step(base::Time until) {
  if (on_wire_) {
    if (on_wire_->event.end > until) return false;
    finish();
  } else {
    VirtualStation* const recovering = next_recovery();
    const base::Time start = earliest_start();
    if (recovering != nullptr && recovering->recovered_at(idle_since_) <= std::min(start, until)) {
      now_ = std::max(now_, recovering->recovered_at(idle_since_));
      recovering->recover(now_);
    } else {
      if (start >= until) return false;
      begin(start);
      return true;
    }
  }
  for (const auto& station : stations_) station->tell_news();
  return true;
}

base::Time VirtualBus::earliest_start() const {
  base::Time earliest = base::Time::max();
  for (const auto& station : stations_) {
    earliest = std::min(earliest, station->earliest_start(idle_since_));
  }
  // What reached the bus late, from another thread, cannot begin in the past.
  return std::max(earliest, now_);
}

VirtualStation* VirtualBus::next_recovery() {
  VirtualStation* next = nullptr;
  for (const auto& station : stations_) {
    if (station->recovering() &&
        (next == nullptr || station->recovered_at(idle_since_) < next->recovered_at(idle_since_))) {
      next = station.get();
    }
  }
  return next;
}

/// The frame that wins the bus at that time, and what will become of it.
VirtualBus::Transmission VirtualBus::plan(base::Time begin) {
  VirtualStation* winner = nullptr;
  const VirtualStation::Outgoing* frame = nullptr;
  for (const auto& station : stations_) {
    const auto* candidate = station->candidate(begin);
    if (candidate == nullptr) continue;
    if (frame == nullptr || arbitration_word(candidate->frame) < arbitration_word(frame->frame)) {
      winner = station.get();
      frame = candidate;
    }
  }
  Outcome outcome = Outcome::kGood;
  if (const Fault* fault = fault_for(frame->frame)) outcome = fault->outcome;
  if (destroyed(*winner)) {
    outcome = Outcome::kCorrupted;
  } else if (!acknowledged(*winner)) {
    outcome = Outcome::kNoAcknowledgement;
  }
  return {winner, frame->number,
          WireEvent{frame->frame, begin, begin + duration(frame->frame, outcome), outcome, winner}};
}

VirtualBus::Fault* VirtualBus::fault_for(const Frame& frame) {
  const auto found = std::ranges::find_if(faults_, [&](const Fault& fault) {
    return fault.count > 0 && (!fault.which || fault.which->passes(frame));
  });
  return found == faults_.end() ? nullptr : &*found;
}

bool VirtualBus::acknowledged(const VirtualStation& sender) const {
  return !cut_ && std::ranges::any_of(stations_, [&](const auto& station) {
    return station.get() != &sender && station->understands();
  });
}

/// By a wrong bit rate: of the sender, if anybody else is there, or of one that listens.
bool VirtualBus::destroyed(const VirtualStation& sender) const {
  return !cut_ && std::ranges::any_of(stations_, [&](const auto& station) {
    if (station.get() == &sender) return false;
    return sender.understands() ? station->destroys_others() : station->on_bus();
  });
}

base::Duration VirtualBus::duration(const Frame& frame, Outcome outcome) const {
  int bits = frame_bits(frame);
  if (outcome == Outcome::kCorrupted) bits += kErrorFrameBits - kFrameTailBits;
  // The sender sees the missing acknowledgement in its slot, two bits behind the checksum.
  if (outcome == Outcome::kNoAcknowledgement) bits += 2 + kLonelyErrorFrameBits - kFrameTailBits;
  return bits_time(bits, bit_rate_);
}

void VirtualBus::begin(base::Time at) {
  now_ = at;
  on_wire_ = plan(at);
  const Transmission& begun = *on_wire_;
  for (const auto& station : stations_) {
    if (station->recovering()) station->count_recessive(idle_since_, at);
    const auto* other = station->candidate(at);
    if (station.get() != begun.sender && other != nullptr &&
        arbitration_word(other->frame) == arbitration_word(begun.event.frame)) {
      ++counters_.collisions;
    }
  }
  Fault* const fault = fault_for(begun.event.frame);
  if (fault != nullptr && fault->outcome == begun.event.outcome) --fault->count;
}

void VirtualBus::finish() {
  Transmission done = *on_wire_;
  on_wire_.reset();
  now_ = std::max(now_, done.event.end);
  idle_since_ = done.event.end;
  if (!done.sender->on_bus() || done.sender->find(done.number) == nullptr) {
    done.event.outcome = Outcome::kAborted;
  }
  for (const auto& station : stations_) {
    if (station->recovering()) station->count_frame_end();
  }
  count(done.event);
  if (tap_) tap_(done.event);
  if (done.event.outcome == Outcome::kGood || done.event.outcome == Outcome::kLost) {
    end_good(done);
  } else if (done.event.outcome != Outcome::kAborted) {
    end_with_error(done);
  }
}

void VirtualBus::end_good(const Transmission& done) {
  const WireEvent& event = done.event;
  const bool lost = event.outcome == Outcome::kLost;
  done.sender->remove(done.number);
  done.sender->count_good_sent(event.end);
  done.sender->suspend_if_passive(event.end);
  for (const auto& station : stations_) {
    const bool own = station.get() == done.sender;
    if (!station->on_bus() || (own && !station->options_.own_frames)) continue;
    if (!station->understands()) {
      hear_noise(*station, event.end);
      continue;
    }
    if (!own) station->count_good_received(event.end);
    if (lost && !own) {
      station->miss(event.frame);
    } else {
      station->deliver({event.frame, event.end, own});
    }
  }
}

void VirtualBus::end_with_error(const Transmission& done) {
  VirtualStation& sender = *done.sender;
  const base::Time end = done.event.end;
  if (done.event.outcome == Outcome::kNoAcknowledgement) {
    sender.report(error_class::kNoAcknowledgement, 0, end);
    // A passive sender that is alone does not count, or it would go off before anybody comes.
    if (sender.state() == BusState::kActive) sender.add_send_errors(8, end);
  } else {
    for (const auto& station : stations_) {
      if (!station->on_bus()) continue;
      if (station.get() == &sender) {
        station->report(error_class::kProtocol | error_class::kBusError, 0, end);
      } else {
        hear_noise(*station, end);
      }
    }
    sender.add_send_errors(8, end);
  }
  sender.suspend_if_passive(end);
}

/// Who raises the flag that the others follow sees them do it, and counts eight more (ISO 11898).
void VirtualBus::hear_noise(VirtualStation& station, base::Time end) {
  const bool raised_the_flag = station.destroys_others();
  station.report(error_class::kProtocol | error_class::kBusError, 0, end);
  station.add_receive_errors(raised_the_flag ? 9 : 1, end);
}

void VirtualBus::count(const WireEvent& event) {
  counters_.busy += event.end - event.begin;
  switch (event.outcome) {
    case Outcome::kGood:
      ++counters_.good;
      break;
    case Outcome::kCorrupted:
      ++counters_.corrupted;
      break;
    case Outcome::kNoAcknowledgement:
      ++counters_.not_acknowledged;
      break;
    case Outcome::kLost:
      ++counters_.lost;
      break;
    case Outcome::kAborted:
      ++counters_.aborted;
      break;
  }
}

void VirtualBus::lose_next(std::uint64_t count, std::optional<Filter> which) {
  faults_.push_back({count, which, Outcome::kLost});
}

void VirtualBus::corrupt_next(std::uint64_t count, std::optional<Filter> which) {
  faults_.push_back({count, which, Outcome::kCorrupted});
}

}  // namespace armature::can
