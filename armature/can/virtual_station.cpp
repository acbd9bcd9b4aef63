// SPDX-License-Identifier: Apache-2.0
#include "armature/can/virtual_station.hpp"

#include <algorithm>
#include <utility>

#include "armature/can/virtual_bus.hpp"

namespace armature::can {
namespace {

constexpr int kMostActive = 127;
constexpr int kMostOnBus = 255;
constexpr int kRecessiveBits = 11;
constexpr int kRecoverySequences = 128;
constexpr int kSuspendBits = 8;

}  // namespace

VirtualStation::VirtualStation(VirtualBus& bus, std::string name, SendOrder order)
    : Bus(std::move(name)), bus_(bus), order_(order), bit_rate_(bus.bit_rate()) {}

bool VirtualStation::open(const BusOptions& options, base::Diagnostics& diagnostics) {
  if (state() != BusState::kClosed) {
    diagnostics.error({}, "bus '" + name() + "' is open already",
                      "close it first, or give each driver a station of its own");
    return false;
  }
  if (!check_options(name(), options, diagnostics)) return false;
  options_ = options;
  outbox_.emplace(options.send_capacity, rt::WhenFull::kDropNewest, Outgoing{});
  inbox_.emplace(options.receive_capacity, rt::WhenFull::kDropNewest, Arrival{});
  queue_.reserve(options.send_capacity);
  send_errors_ = 0;
  receive_errors_ = 0;
  suspended_until_ = {};
  recovering_ = false;
  restart_asked_ = false;
  state_ = BusState::kActive;
  return true;
}

void VirtualStation::close() {
  if (state() == BusState::kClosed) return;
  state_ = BusState::kClosed;
  recovering_ = false;
  discard_all();
  while (inbox_->pop() != nullptr) internal::Tally::add(tally_.lost);
}

SendStatus VirtualStation::send(const Frame& frame) {
  return tally_.answer(take(frame, bus_.time_of_sending()));
}

SendStatus VirtualStation::send_at(const Frame& frame, base::Time earliest) {
  return tally_.answer(take(frame, std::max(earliest, bus_.time_of_sending())));
}

SendStatus VirtualStation::take(const Frame& frame, base::Time earliest) {
  if (!can_be_sent(frame)) return SendStatus::kInvalid;
  const BusState now = state();
  if (now == BusState::kClosed) return SendStatus::kDown;
  if (now == BusState::kBusOff) return SendStatus::kBusOff;
  if (waiting_.load(std::memory_order_acquire) >= options_.send_capacity) {
    return SendStatus::kQueueFull;
  }
  waiting_.fetch_add(1, std::memory_order_relaxed);
  outbox_->push({frame, earliest, 0});  // has room for all that may wait
  return SendStatus::kSent;
}

ReceiveStatus VirtualStation::receive(Arrival& arrival) {
  if (state() == BusState::kClosed) return ReceiveStatus::kDown;
  const Arrival* const oldest = inbox_->pop();
  if (oldest == nullptr) return ReceiveStatus::kNothing;
  arrival = *oldest;
  return ReceiveStatus::kReceived;
}

RestartStatus VirtualStation::restart() {
  if (state() != BusState::kBusOff) return RestartStatus::kNotNeeded;
  restart_time_.store(bus_.time_of_sending(), std::memory_order_relaxed);
  restart_asked_.store(true, std::memory_order_release);
  return RestartStatus::kRestarting;
}

void VirtualStation::force_bus_off() {
  if (state() == BusState::kClosed) return;
  send_errors_ = kMostOnBus + 1;
  update_state(bus_.now());
  tell_news();
}

bool VirtualStation::on_bus() const {
  const BusState now = state();
  return !dead_ && (now == BusState::kActive || now == BusState::kPassive);
}

bool VirtualStation::understands() const { return on_bus() && bit_rate_ == bus_.bit_rate(); }

/// Only an active station may.
bool VirtualStation::destroys_others() const {
  return !understands() && !dead_ && state() == BusState::kActive;
}

void VirtualStation::collect() {
  if (state() == BusState::kClosed) return;
  if (state() == BusState::kBusOff) discard_all();  // sent before the sender could know
  while (const Outgoing* sent = outbox_->pop()) {
    queue_.push_back({sent->frame, sent->earliest + delay_, ++taken_});
  }
  if (restart_asked_.exchange(false, std::memory_order_acquire) && !recovering() &&
      state() == BusState::kBusOff) {
    recovering_ = true;
    recessive_left_ = kRecoverySequences;
    recovery_begin_ = restart_time_.load(std::memory_order_relaxed);
  }
}

base::Time VirtualStation::earliest_start(base::Time idle_since) const {
  base::Time earliest = base::Time::max();
  if (!on_bus()) return earliest;
  for (const Outgoing& waiting : queue_) {
    earliest = std::min(earliest, std::max({waiting.earliest, suspended_until_, idle_since}));
  }
  return earliest;
}

const VirtualStation::Outgoing* VirtualStation::candidate(base::Time at) const {
  if (!on_bus() || suspended_until_ > at) return nullptr;
  const auto before = [this](const Outgoing& a, const Outgoing& b) {
    if (order_ == SendOrder::kMostUrgent) {
      const std::uint32_t word_a = arbitration_word(a.frame);
      const std::uint32_t word_b = arbitration_word(b.frame);
      if (word_a != word_b) return word_a < word_b;
    }
    return a.earliest != b.earliest ? a.earliest < b.earliest : a.number < b.number;
  };
  const Outgoing* best = nullptr;
  for (const Outgoing& waiting : queue_) {
    if (waiting.earliest <= at && (best == nullptr || before(waiting, *best))) best = &waiting;
  }
  return best;
}

const VirtualStation::Outgoing* VirtualStation::find(std::uint64_t number) const {
  const auto found = std::ranges::find(queue_, number, &Outgoing::number);
  return found == queue_.end() ? nullptr : &*found;
}

void VirtualStation::remove(std::uint64_t number) {
  const std::size_t removed =
      std::erase_if(queue_, [number](const Outgoing& each) { return each.number == number; });
  waiting_.fetch_sub(removed, std::memory_order_release);
}

void VirtualStation::discard_all() {
  std::size_t discarded = queue_.size();
  queue_.clear();
  while (outbox_->pop() != nullptr) ++discarded;
  waiting_.fetch_sub(discarded, std::memory_order_release);
  internal::Tally::add(tally_.discarded, discarded);
}

void VirtualStation::deliver(const Arrival& arrival) {
  if (!passes(options_, arrival.frame)) return;
  const bool taken = inbox_->push(arrival) == rt::PushResult::kTaken;
  internal::Tally::add(taken ? tally_.received : tally_.lost);
  news_ = true;
}

void VirtualStation::miss(const Frame& frame) {
  if (passes(options_, frame)) internal::Tally::add(tally_.lost);
}

void VirtualStation::report(std::uint32_t error, std::uint8_t problem, base::Time now) {
  Frame frame;
  frame.kind = FrameKind::kError;
  frame.id = error;
  frame.size = Frame::kMostData;
  frame.data[1] = problem;
  internal::Tally::add(tally_.error_frames);
  deliver({frame, now, false});
}

void VirtualStation::tell_news() {
  if (std::exchange(news_, false) && options_.on_news) options_.on_news();
}

void VirtualStation::add_send_errors(int by, base::Time now) {
  send_errors_ += by;
  update_state(now);
}

void VirtualStation::add_receive_errors(int by, base::Time now) {
  receive_errors_ = std::min(receive_errors() + by, kMostOnBus);
  update_state(now);
}

void VirtualStation::count_good_sent(base::Time now) {
  send_errors_ = std::max(send_errors() - 1, 0);
  update_state(now);
}

void VirtualStation::count_good_received(base::Time now) {
  // A passive receiver that hears well again is active at once: CAN sets it to 119 to 127.
  const int errors = receive_errors();
  receive_errors_ = errors > kMostActive ? kMostActive : std::max(errors - 1, 0);
  update_state(now);
}

void VirtualStation::suspend_if_passive(base::Time frame_end) {
  if (state() != BusState::kPassive) return;
  suspended_until_ = frame_end + bits_time(kSuspendBits, bus_.bit_rate());
}

void VirtualStation::update_state(base::Time now) {
  const bool send_passive = send_errors() > kMostActive;
  const bool passive = send_passive || receive_errors() > kMostActive;
  if (send_errors() > kMostOnBus) {
    enter(BusState::kBusOff, now);
  } else {
    enter(passive ? BusState::kPassive : BusState::kActive, now);
  }
}

void VirtualStation::enter(BusState next, base::Time now) {
  const BusState before = state();
  if (next == before) return;
  state_.store(next, std::memory_order_release);
  news_ = true;
  if (next == BusState::kBusOff) {
    internal::Tally::add(tally_.bus_offs);
    discard_all();
    report(error_class::kBusOff, 0, now);
  } else if (next == BusState::kPassive) {
    const bool sending = send_errors() > kMostActive;
    report(error_class::kController,
           sending ? controller_problem::kSendPassive : controller_problem::kReceivePassive, now);
  } else if (before == BusState::kPassive) {
    report(error_class::kController, controller_problem::kActiveAgain, now);
  }
}

base::Time VirtualStation::recovered_at(base::Time idle_since) const {
  return std::max(idle_since, recovery_begin_) +
         bits_time(std::int64_t{kRecessiveBits} * recessive_left_, bus_.bit_rate());
}

void VirtualStation::count_recessive(base::Time idle_since, base::Time until) {
  const base::Duration quiet = until - std::max(idle_since, recovery_begin_);
  const base::Duration sequence = bits_time(kRecessiveBits, bus_.bit_rate());
  if (quiet > base::Duration{}) recessive_left_ -= static_cast<int>(quiet / sequence);
  recessive_left_ = std::max(recessive_left_, 0);
}

void VirtualStation::recover(base::Time now) {
  recovering_ = false;
  send_errors_ = 0;
  receive_errors_ = 0;
  suspended_until_ = {};
  report(error_class::kRestarted, 0, now);
  enter(BusState::kActive, now);
}

}  // namespace armature::can
