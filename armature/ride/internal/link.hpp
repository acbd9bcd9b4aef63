// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "armature/platform/sockets/poller.hpp"
#include "armature/ride/answer.hpp"
#include "armature/ride/internal/assembler.hpp"
#include "armature/ride/internal/event_queue.hpp"
#include "armature/ride/internal/open_calls.hpp"
#include "armature/ride/internal/outgoing.hpp"
#include "armature/ride/internal/reading.hpp"
#include "armature/ride/internal/waiting.hpp"
#include "armature/ride/memory_share.hpp"
#include "armature/ride/node.hpp"
#include "armature/ride/transport.hpp"

namespace armature::ride::internal {

class Link;
class PeerState;

/// Whom a message is for: known, or looked up anew for each connection (0: not yet).
class Recipient {
 public:
  explicit Recipient(std::uint32_t known) : known_(known) {}
  explicit Recipient(const std::atomic<std::uint32_t>& looked_up) : looked_up_(&looked_up) {}

  /// With the link's lock held, under which it changes.
  std::optional<std::uint32_t> identifier() const {
    if (looked_up_ == nullptr) return known_;
    const std::uint32_t found = looked_up_->load(std::memory_order_relaxed);
    return found != 0 ? std::optional(found) : std::nullopt;
  }

 private:
  std::uint32_t known_ = 0;
  const std::atomic<std::uint32_t>* looked_up_ = nullptr;
};

/// Why a message is not taken.
struct Refusal {
  Code code;
  std::string text;
};

/// What a link needs of its node. Called with the link's lock held, by any thread.
class LinkHost {
 public:
  virtual ~LinkHost() = default;
  /// So many messages came.
  virtual void count(std::uint64_t messages) = 0;
  /// A message that is not the answer to a call.
  virtual void deliver(Link& link, const Message& message) = 0;
  /// Its connection has ended.
  virtual void attend(Link& link) = 0;
  /// Messages were gathered that the I/O thread is to send.
  virtual void flush_soon(Link& link) = 0;
  /// A subscriber that is too slow has lost its oldest event.
  virtual void event_dropped(const EventQueue& queue) = 0;
  /// A caller has taken over reading, and will not say when it is over.
  virtual void return_soon(Link& link) = 0;
  /// The other side was told that what it has sent is at fault.
  virtual void refused(const Link& link, Code code, const Message& message,
                       std::string_view text) = 0;
  /// Whether a body that goes on in several messages is to be taken; its first message.
  /// @return why not
  virtual std::optional<Refusal> refusal_of(const Link& link, const Message& first,
                                            const std::string& identity) = 0;
};

/// A connection with its messages: what is to be sent, what was received, the calls that are open.
/// That of a peer is used again for each of its connections.
///
/// One thread reads at a time: the I/O thread, or a caller who waits for its answer. A caller takes
/// over without a word and gives back lazily, so that calls in a row cost no system call but their
/// own; where events are subscribed it gives back at once.
class Link : public std::enable_shared_from_this<Link>, private BodyGate {
 public:
  enum class Flush { kNow, kGather };
  /// Of the node's memory, whatever others take: what is received, and as much again.
  static constexpr std::size_t kReserve = 2 * Assembler::kRoom;

  Link(LinkHost& host, platform::Poller& poller, const Limits& limits,
       std::shared_ptr<MemoryBound> memory);
  Link(const Link&) = delete;
  Link& operator=(const Link&) = delete;

  // What the I/O thread does.

  /// Begins with a connection that is yet to be established.
  void begin(std::unique_ptr<Connection> connection);
  /// True once data can flow; false as long as it cannot. A failure breaks it off.
  bool establish();
  /// If it takes long to bring up: nobody watches it any more, nor forgets it, until `come_back`.
  /// @return true if it does, and is not up yet
  bool hold();
  /// The next step of one that is held. Takes no lock that others wait for.
  /// @thread for whom it was held
  Progress step_held() { return connection_->establish(); }
  /// Goes on with what came of that, as `establish` does.
  bool come_back(Progress progress);
  /// Receives what is there and delivers it.
  /// @param size  how many bytes that was
  /// @return the number of the oldest message that has begun and not ended, if there is one
  std::optional<std::uint64_t> read(std::size_t& size);
  /// Has the poller tell once more what can be read: it was not, or not all of it.
  void look_again();
  /// Sends what could not be sent before.
  /// @return true if reading has waited for that
  bool write();
  /// Sends what was gathered `age` ago; false if there is nothing.
  bool flush(base::Time now, base::Duration age);
  /// Breaks it off if the other side has taken nothing for so long, and keeps memory of others.
  void end_if_stuck(base::Time now, base::Duration limit);
  /// Takes reading back from a caller who has gone; false if there still is one.
  bool take_back();
  /// The number of the oldest message that has begun and not ended, whoever reads it.
  std::optional<std::uint64_t> incomplete() const;
  /// True if its connection has ended and was not forgotten.
  bool ended() const;
  /// Forgets a connection that has ended; false if another thread has yet to notice.
  bool close();
  /// Stops or resumes reading.
  void set_throttled(bool throttled);
  /// Whether events are subscribed.
  void set_listens(bool listens);

  // What any thread does.

  /// Sends a message. `head`: operation or event, as the type has it.
  Sent send(Priority priority, Type type, const Recipient& recipient,
            std::initializer_list<std::uint32_t> head, const Fields& fields, Flush flush);
  Sent send_control(std::uint32_t call, const Control& control);
  /// Answers a message that is at fault.
  void refuse(Code code, const Message& message, std::string_view text);
  /// Counts an event that could not be sent.
  void lose_event(const EventQueue& queue);
  /// Why the connection has ended, or who the other end is; with the lock held.
  std::string end_locked() const { return connection_ ? connection_->other_end() : "nobody"; }
  /// Sends an event that was encoded before, or puts it into the queue.
  void send_event(EventQueue& queue, std::span<const std::byte> message, base::Time now);
  /// Sends a request and waits.
  void call(Number operation, const Recipient& recipient, const CallOptions& options,
            const Fields& parameters, WaitingCall& call);
  /// Sends a request; `call` is told of the answer.
  void call(Number operation, Priority priority, const Recipient& recipient,
            const Fields& parameters, std::unique_ptr<CallbackCall> call);
  /// Ends the connection; calls that are open fail.
  void break_off(const std::string& why);

  /// True if the other side sends no more, and is owed something.
  bool is_leaving() const { return leaving_.load(std::memory_order_relaxed); }
  /// Ends the connection of one that is leaving once it has been answered all it has asked.
  /// @thread the I/O thread
  void let_go_if_leaving();
  /// One of `kept_replies` was given.
  void reply_was_given();

  bool open() const { return open_.load(std::memory_order_acquire); }
  /// Counts the connections that it has had.
  std::uint32_t connection_number() const { return connections_.load(std::memory_order_relaxed); }
  std::string other_end() const;
  std::string identity() const;
  std::string problem() const;
  std::mutex& mutex() { return mutex_; }

  /// Of the node's memory.
  const std::shared_ptr<MemoryShare> memory;

  // Bookkeeping of the I/O thread.
  PeerState* peer = nullptr;  ///< whose link it is, if this side has connected
  std::string scheme;
  bool established = false;
  bool shakes_hands = false;  ///< in a thread of its own
  bool greeted = false;
  base::Time incomplete_since = base::Time::max();  ///< its handshake, or a message
  std::uint64_t incomplete_message = 0;
  base::Time window_end{};
  std::uint64_t window_messages = 0;
  bool throttled = false;
  bool sends_much = false;      ///< as of the last time it was read
  bool waits_for_turn = false;  ///< to be read again
  Waiting waiting{this, memory.get()};
  std::atomic<std::size_t> kept_replies{0};
  std::vector<std::shared_ptr<EventQueue>> event_queues;  ///< with the lock held

  /// Messages since it began.
  std::uint64_t received() const { return received_.load(std::memory_order_relaxed); }
  /// Changes whenever something came, or something was taken that had to wait: it lives.
  std::uint64_t signs_of_life() const { return signs_of_life_.load(std::memory_order_relaxed); }

 private:
  Sent send_locked(Priority priority, Type type, std::uint32_t recipient,
                   std::initializer_list<std::uint32_t> head, const Fields& fields, Flush flush);
  Sent no_memory_for(Type type, std::uint32_t recipient);
  bool admits(const Message& first) override;
  bool too_much_for(Type type);
  bool is_backed_up() const;
  bool establish_locked(Progress progress);
  void send_out();
  void gather(base::Time now);
  void transmit();
  void drain_event_queues();
  void drain(EventQueue& queue);
  void arrived(std::size_t size);
  void look_again_locked();
  void take_messages();
  void take_message(const Message& message);
  void refuse_locked(Code code, const Message& message, std::string_view text);
  void end_with(Code code, const Message& message, const std::string& text);
  void break_off_locked(const std::string& why);
  void hear_the_end();
  template <typename Step>
  bool reserves(const Step& step);
  void receive_once(base::Duration limit, std::unique_lock<std::mutex>& lock);
  bool take_reading();
  void return_later();
  void leave_reading();
  platform::Interest wanted() const;
  void update_interest();

  LinkHost& host_;
  platform::Poller& poller_;
  /// So short that to say it needs no memory.
  static constexpr const char* kNoMemory = "no memory";

  const Limits& limits_;

  mutable std::mutex mutex_;
  std::unique_ptr<Connection> connection_;
  std::atomic<bool> open_{false};
  std::atomic<bool> leaving_{false};
  std::atomic<std::uint32_t> connections_{0};
  Assembler assembler_;
  Outgoing out_;
  bool reading_waits_ = false;  ///< until it can write
  OpenCalls calls_;
  Reading reading_;
  Progress establishing_ = Progress::kDone;
  bool held_ = false;
  platform::Interest interest_;
  std::string problem_;
  std::atomic<std::uint64_t> received_{0};
  std::atomic<std::uint64_t> signs_of_life_{0};
};

}  // namespace armature::ride::internal
