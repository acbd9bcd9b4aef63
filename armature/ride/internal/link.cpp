// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/internal/link.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "armature/platform/clock.hpp"

namespace armature::ride::internal {

Link::Link(LinkHost& host, platform::Poller& poller, const Limits& limits,
           std::shared_ptr<MemoryBound> all)
    : memory(std::make_shared<MemoryShare>(std::move(all), kReserve)),
      host_(host),
      poller_(poller),
      limits_(limits),
      assembler_(limits.body_bytes, memory.get(), this),
      out_(memory.get()) {}

void Link::begin(std::unique_ptr<Connection> connection) {
  const std::lock_guard lock(mutex_);
  connection_ = std::move(connection);
  connections_.fetch_add(1, std::memory_order_relaxed);
  problem_.clear();
  establishing_ = Progress::kWantWrite;
  interest_ = {.write = true};
  reading_.give_to_node();
  poller_.add(connection_->handle(), reinterpret_cast<std::uintptr_t>(this), interest_);
}

bool Link::hold() {
  const std::lock_guard lock(mutex_);
  if (!connection_ || !problem_.empty() || establishing_ == Progress::kDone) return false;
  if (!connection_->establishes_slowly()) return false;
  poller_.remove(connection_->handle());
  held_ = true;
  return true;
}

bool Link::come_back(Progress progress) {
  const std::lock_guard lock(mutex_);
  held_ = false;
  if (!problem_.empty()) {
    // Broken off meanwhile: who wanted to forget it could not.
    connection_->shut_down();
    host_.attend(*this);
    return false;
  }
  establishing_ = progress;
  interest_ = wanted();
  poller_.add(connection_->handle(), reinterpret_cast<std::uintptr_t>(this), interest_);
  return establish_locked(progress);
}

bool Link::establish() {
  const std::lock_guard lock(mutex_);
  if (!connection_ || !problem_.empty()) return false;
  if (establishing_ == Progress::kDone) return true;
  return establish_locked(connection_->establish());
}

bool Link::establish_locked(Progress progress) {
  establishing_ = progress;
  if (progress == Progress::kGone) {
    break_off_locked(connection_->problem());
    return false;
  }
  if (progress == Progress::kDone) open_.store(true, std::memory_order_release);
  update_interest();
  return progress == Progress::kDone;
}

void Link::let_go_if_leaving() {
  if (!is_leaving() || !waiting.empty()) return;
  const std::lock_guard lock(mutex_);
  if (!open() || out_.unsent() != 0 || kept_replies.load(std::memory_order_relaxed) != 0) return;
  break_off_locked(connection_->problem());
}

void Link::reply_was_given() {
  kept_replies.fetch_sub(1, std::memory_order_relaxed);
  if (is_leaving()) host_.attend(*this);
}

void Link::look_again() {
  const std::lock_guard lock(mutex_);
  look_again_locked();
}

/// The poller tells only what is new of a connection that takes all.
void Link::look_again_locked() {
  if (!connection_ || !problem_.empty() || held_ || !interest_.news) return;
  poller_.change(connection_->handle(), reinterpret_cast<std::uintptr_t>(this), interest_);
}

bool Link::write() {
  const std::lock_guard lock(mutex_);
  if (!open()) return false;
  const bool has_waited = std::exchange(reading_waits_, false);
  if (out_.unblock()) {
    signs_of_life_.fetch_add(1, std::memory_order_relaxed);
    transmit();
    drain_event_queues();
  }
  update_interest();
  return has_waited && interest_.read;
}

bool Link::flush(base::Time now, base::Duration age) {
  const std::lock_guard lock(mutex_);
  if (!open() || out_.empty() || out_.blocked()) {
    out_.end_gathering();
    return false;
  }
  if (now - out_.gathered_since() >= age) transmit();
  return true;
}

bool Link::ended() const {
  const std::lock_guard lock(mutex_);
  return connection_ != nullptr && !problem_.empty();
}

bool Link::close() {
  const std::lock_guard lock(mutex_);
  if (reading_.is_of_caller() || held_) return false;
  connection_.reset();
  assembler_.reset();
  out_.clear();
  reading_waits_ = false;
  establishing_ = Progress::kDone;
  reading_.give_to_node();
  event_queues.clear();
  leaving_.store(false, std::memory_order_relaxed);
  established = false;
  shakes_hands = false;
  greeted = false;
  incomplete_since = base::Time::max();
  throttled = false;
  sends_much = false;
  return true;
}

void Link::set_throttled(bool on) {
  const std::lock_guard lock(mutex_);
  throttled = on;
  update_interest();
}

void Link::set_listens(bool listens) {
  const std::lock_guard lock(mutex_);
  reading_.set_listens(listens);
}

void Link::break_off(const std::string& why) {
  const std::lock_guard lock(mutex_);
  break_off_locked(why);
}

void Link::break_off_locked(const std::string& why) {
  if (!connection_ || !problem_.empty()) return;
  problem_ = why;
  open_.store(false, std::memory_order_release);
  if (!held_) {
    poller_.remove(connection_->handle());
    connection_->shut_down();
  }
  calls_.refuse_all(Code::kConnectionLost, why);
  host_.attend(*this);
}

std::string Link::other_end() const {
  const std::lock_guard lock(mutex_);
  return connection_ ? connection_->other_end() : std::string("nobody");
}

std::string Link::identity() const {
  const std::lock_guard lock(mutex_);
  return connection_ ? connection_->identity() : std::string();
}

std::string Link::problem() const {
  const std::lock_guard lock(mutex_);
  return problem_;
}

platform::Interest Link::wanted() const {
  const bool flows = establishing_ == Progress::kDone;
  const bool takes_nothing = peer == nullptr && is_backed_up();
  const bool reads =
      reading_.is_of_node() && !throttled && !takes_nothing && !reading_waits_ && !is_leaving();
  return {flows ? reads : establishing_ == Progress::kWantRead,
          flows ? out_.blocked() || reading_waits_ : establishing_ == Progress::kWantWrite,
          flows && connection_->takes_all()};
}

void Link::update_interest() {
  if (!connection_ || !problem_.empty() || held_) return;
  const platform::Interest now = wanted();
  if (now.read == interest_.read && now.write == interest_.write) return;
  interest_ = now;
  poller_.change(connection_->handle(), reinterpret_cast<std::uintptr_t>(this), now);
}

// ---- Sending

Sent Link::send(Priority priority, Type type, const Recipient& recipient,
                std::initializer_list<std::uint32_t> head, const Fields& fields, Flush flush) {
  const std::lock_guard lock(mutex_);
  const auto identifier = recipient.identifier();
  if (!open() || !identifier) return Sent::kNotConnected;
  return send_locked(priority, type, *identifier, head, fields, flush);
}

Sent Link::send_control(std::uint32_t call, const Control& control) {
  const auto fields = std::tie(control);
  return send({}, Type::kControl, Recipient(call), {}, Fields(fields), Flush::kNow);
}

void Link::refuse(Code code, const Message& message, std::string_view text) {
  const std::lock_guard lock(mutex_);
  refuse_locked(code, message, text);
}

/// Of a request the operation and the call are the first words of its body.
void Link::refuse_locked(Code code, const Message& message, std::string_view text) {
  if (!open()) return;
  host_.refused(*this, code, message, text);
  if (message.header.type == Type::kControl && code != Code::kBadMagic) return;  // No ping-pong.
  const bool is_request = message.header.type == Type::kRequest;
  const bool has_operation = is_request || message.header.type == Type::kCommand;
  Decoder from(message.body);
  Control control{code, static_cast<std::uint32_t>(message.header.type), message.header.identifier,
                  0, text};
  std::uint32_t call = 0;
  if (code == Code::kBadMagic) control.type = 0;
  if (has_operation && from.take(control.operation) && is_request) from.take(call);
  const auto fields = std::tie(control);
  send_locked({}, Type::kControl, call, {}, Fields(fields), Flush::kNow);
}

/// What is owed is sent as long as memory stays bounded: who does not take it is not read either.
bool Link::too_much_for(Type type) {
  if (!is_backed_up()) return false;
  if (type != Type::kReply && type != Type::kControl) return true;
  if (out_.unsent() < limits_.unsent_bytes + limits_.body_bytes) return false;
  break_off_locked("it does not read what it is sent");
  return true;
}

bool Link::is_backed_up() const { return out_.blocked() && out_.unsent() >= limits_.unsent_bytes; }

Sent Link::send_locked(Priority priority, Type type, std::uint32_t recipient,
                       std::initializer_list<std::uint32_t> head, const Fields& fields,
                       Flush flush) {
  if (too_much_for(type)) return open() ? Sent::kQueueFull : Sent::kNotConnected;
  const bool appended = out_.append(priority, [&](Body& out) {
    const std::size_t start = out.size();
    out.extend(Header::kSize);
    Encoder body(out);
    for (const std::uint32_t word : head) body.put(word);
    fields.put(body);
    finish_message(out, start, priority, type, recipient);
  });
  if (!appended) return no_memory_for(type, recipient);
  if (flush == Flush::kNow) {
    send_out();
  } else {
    gather(platform::monotonic_now());
  }
  return open() ? Sent::kYes : Sent::kNotConnected;
}

/// Who waits for an answer is told, so it does not wait for nothing.
Sent Link::no_memory_for(Type type, std::uint32_t recipient) {
  if (type == Type::kReply) {
    host_.refused(*this, Code::kBusy, {{.type = type, .identifier = recipient}, {}}, kNoMemory);
    const Control control{Code::kBusy, static_cast<std::uint32_t>(Type::kRequest), 0, 0,
                          "not enough memory for the answer"};
    const auto fields = std::tie(control);
    return send_locked({}, Type::kControl, recipient, {}, Fields(fields), Flush::kNow);
  }
  if (type != Type::kControl) return Sent::kQueueFull;
  break_off_locked(kNoMemory);
  return Sent::kNotConnected;
}

/// Sends what was appended.
void Link::send_out() {
  if (out_.blocked()) return update_interest();
  transmit();
}

/// The same, or it waits for what follows.
void Link::gather(base::Time now) {
  if (out_.blocked()) return update_interest();
  switch (out_.gather(now)) {
    case Outgoing::Gather::kSend:
      return transmit();
    case Outgoing::Gather::kWait:
      return;
    case Outgoing::Gather::kWaitAnew:
      return host_.flush_soon(*this);
  }
}

void Link::transmit() {
  const Progress progress = out_.transmit(*connection_);
  if (progress == Progress::kGone) return break_off_locked(connection_->problem());
  if (progress != Progress::kDone) update_interest();
}

void Link::end_if_stuck(base::Time now, base::Duration limit) {
  const std::lock_guard lock(mutex_);
  if (!open() || !memory->exceeds_reserve() || !out_.is_stuck(now, limit)) return;
  break_off_locked("it does not read what it is sent, and other connections need the memory");
}

void Link::lose_event(const EventQueue& queue) {
  const std::lock_guard lock(mutex_);
  host_.event_dropped(queue);
}

void Link::send_event(EventQueue& queue, std::span<const std::byte> message, base::Time now) {
  const std::lock_guard lock(mutex_);
  if (!open()) return;
  if (!out_.blocked()) {
    if (out_.append_event(queue.subscription, message)) return gather(now);
    return host_.event_dropped(queue);
  }
  if (!queue.push(message)) host_.event_dropped(queue);
}

/// What waits of the most urgent event goes first, all of it.
void Link::drain_event_queues() {
  while (open() && !out_.blocked()) {
    const auto next = std::ranges::max_element(event_queues, {},
                                               [](const auto& queue) { return queue->urgency(); });
    if (next == event_queues.end() || (*next)->empty()) return;
    drain(**next);
  }
}

void Link::drain(EventQueue& queue) {
  while (open() && !out_.blocked() && !queue.empty()) {
    if (!out_.append_event(queue.subscription, queue.front())) host_.event_dropped(queue);
    queue.pop();
    transmit();
  }
}

}  // namespace armature::ride::internal
