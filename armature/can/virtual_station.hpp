// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/can/bus.hpp"
#include "armature/can/frame.hpp"
#include "armature/can/internal/tally.hpp"
#include "armature/rt/ring.hpp"

namespace armature::can {

class VirtualBus;

/// Which of a station's frames competes for the bus.
enum class SendOrder {
  /// The one that was sent first, as a controller with one mailbox does, and so Linux: an urgent
  /// frame may have to wait behind one that is not.
  kFirst,
  /// The one that wins the bus against the others, as a controller with many mailboxes does; among
  /// equals the one that was sent first.
  kMostUrgent,
};

/// One station of a `VirtualBus`: its controller with queues and error counters. Besides being a
/// Bus it does, on demand, what hardware does when it is broken.
class VirtualStation final : public Bus {
 public:
  VirtualStation(VirtualBus& bus, std::string name, SendOrder order);

  bool open(const BusOptions& options, base::Diagnostics& diagnostics) override;
  void close() override;
  SendStatus send(const Frame& frame) override;
  ReceiveStatus receive(Arrival& arrival) override;
  BusState state() const override { return state_.load(std::memory_order_acquire); }
  RestartStatus restart() override;
  BusCounters counters() const override { return tally_.now(); }

  /// Frames that were taken and neither sent nor discarded yet.
  /// @rt nonblocking
  std::size_t waiting() const { return waiting_.load(std::memory_order_acquire); }

  /// Sends `frame` when `earliest` has come: the answer of a device that takes its time.
  /// @rt nonblocking, no allocation
  /// @thread the sender only
  SendStatus send_at(const Frame& frame, base::Time earliest);

  /// The error counters TEC and REC of CAN.
  int send_errors() const { return send_errors_.load(std::memory_order_relaxed); }
  int receive_errors() const { return receive_errors_.load(std::memory_order_relaxed); }

  /// Everything that is sent from now on comes by this much later; 0 ends it.
  /// @thread the one that advances the bus, as for what follows
  void delay_by(base::Duration delay) { delay_ = delay; }
  /// A dead station neither sends nor receives nor acknowledges, and does not know it.
  void set_dead(bool dead) { dead_ = dead; }
  /// Its own idea of the bit rate. With another than the bus's it understands nothing, nobody
  /// understands it, and while it is active its error frames destroy what the others send: it is
  /// passive after 15 frames of theirs, bus-off after 32 attempts of its own.
  void set_bit_rate(std::uint32_t bit_rate) { bit_rate_ = bit_rate; }
  /// As if it had made 256 errors.
  void force_bus_off();

 private:
  friend class VirtualBus;

  struct Outgoing {
    Frame frame;
    base::Time earliest{};
    std::uint64_t number = 0;
  };

  // What the bus does with its stations, in the thread that advances it.
  void collect();
  bool on_bus() const;
  bool understands() const;
  bool destroys_others() const;
  /// When a frame may begin on a bus that has been idle since then; none waits: the end of time.
  base::Time earliest_start(base::Time idle_since) const;
  /// What competes for the bus at that time; nullptr if nothing does.
  const Outgoing* candidate(base::Time at) const;
  const Outgoing* find(std::uint64_t number) const;
  void remove(std::uint64_t number);
  void deliver(const Arrival& arrival);
  void miss(const Frame& frame);
  void report(std::uint32_t error, std::uint8_t controller_problem, base::Time now);
  void tell_news();

  void add_send_errors(int by, base::Time now);
  void add_receive_errors(int by, base::Time now);
  void count_good_sent(base::Time now);
  void count_good_received(base::Time now);
  void suspend_if_passive(base::Time frame_end);

  // Recovery: the bus has to be recessive for 11 bits, 128 times.
  bool recovering() const { return recovering_; }
  base::Time recovered_at(base::Time idle_since) const;
  void count_recessive(base::Time idle_since, base::Time until);
  void count_frame_end() { recessive_left_ = std::max(recessive_left_ - 1, 0); }
  void recover(base::Time now);

  SendStatus take(const Frame& frame, base::Time earliest);
  void update_state(base::Time now);
  void enter(BusState state, base::Time now);
  void discard_all();

  VirtualBus& bus_;
  const SendOrder order_;
  BusOptions options_;
  internal::Tally tally_;
  std::atomic<BusState> state_{BusState::kClosed};
  std::atomic<int> send_errors_{0};
  std::atomic<int> receive_errors_{0};

  // From the sender to the bus.
  std::optional<rt::Ring<Outgoing>> outbox_;
  std::atomic<std::size_t> waiting_{0};  // in the outbox or in the queue
  std::atomic<bool> restart_asked_{false};
  std::atomic<base::Time> restart_time_{};
  // From the bus to the receiver.
  std::optional<rt::Ring<Arrival>> inbox_;

  // The bus's own.
  std::vector<Outgoing> queue_;
  std::uint64_t taken_ = 0;
  base::Time suspended_until_{};
  base::Time recovery_begin_{};
  bool recovering_ = false;
  int recessive_left_ = 0;
  base::Duration delay_{};
  bool dead_ = false;
  std::uint32_t bit_rate_;
  bool news_ = false;
};

}  // namespace armature::can
