// SPDX-License-Identifier: Apache-2.0
// Of Link: what is received, who reads it, and calls, whose answers it brings.
#include <new>
#include <utility>

#include "armature/platform/clock.hpp"
#include "armature/ride/internal/link.hpp"

namespace armature::ride::internal {

/// What cannot go on without memory ends, so that its memory serves the others.
template <typename Step>
bool Link::reserves(const Step& step) {
  try {
    step();
    return true;
  } catch (const std::bad_alloc&) {
    break_off_locked(kNoMemory);
    return false;
  }
}

std::optional<std::uint64_t> Link::read(std::size_t& size) {
  const std::lock_guard lock(mutex_);
  if (!open() || reading_.is_of_caller() || is_leaving()) return std::nullopt;
  if (reading_.claim_for_node()) update_interest();
  std::span<std::byte> room;
  if (!reserves([&] { room = assembler_.room(); })) return std::nullopt;
  const Progress progress = connection_->receive(room, size);
  if (progress == Progress::kGone) hear_the_end();
  if (progress == Progress::kDone) {
    arrived(size);
    if (!reserves([&] { take_messages(); })) return std::nullopt;
  }
  if (progress == Progress::kWantWrite) {
    reading_waits_ = true;
    update_interest();
  }
  if (progress != Progress::kDone || size == room.size()) look_again_locked();
  return open() ? assembler_.incomplete() : std::nullopt;
}

/// Of a peer of this side an end is an end; who has connected may have asked, and wait for answers.
void Link::hear_the_end() {
  if (peer != nullptr || !connection_->may_still_receive()) {
    return break_off_locked(connection_->problem());
  }
  assembler_.reset();
  leaving_.store(true, std::memory_order_relaxed);
  update_interest();
}

bool Link::take_back() {
  const std::lock_guard lock(mutex_);
  if (reading_.take_back()) update_interest();
  return !reading_.returns();
}

/// What was received: answers go to their calls, all else to the node.
void Link::take_messages() {
  Message message;
  std::uint64_t count = 0;
  for (Found found = assembler_.next(message); found != Found::kNothing && open();
       found = assembler_.next(message)) {
    ++count;
    switch (found) {
      case Found::kMessage:
        take_message(message);
        break;
      case Found::kTooLarge:
        refuse_locked(Code::kTooLarge, message, "the body is larger than this node accepts");
        break;
      case Found::kNoMemory:
        refuse_locked(Code::kBusy, message, "not enough memory for it: other connections use it");
        break;
      case Found::kBadMagic:
        return end_with(Code::kBadMagic, {},
                        "the data is not a RIDE message: it does not begin with 'RIDE'");
      case Found::kBadLength:
        return end_with(Code::kMalformed, message, "a length below that of the header");
      case Found::kTooMany:
        return end_with(Code::kTooLarge, message, "too many bodies are under way at once");
      case Found::kNothing:
        break;
    }
  }
  received_.fetch_add(count, std::memory_order_relaxed);
  host_.count(count);
}

/// Nobody knows where the next message begins.
void Link::end_with(Code code, const Message& message, const std::string& text) {
  refuse_locked(code, message, text);
  break_off_locked(text);
}

void Link::take_message(const Message& message) {
  const bool may_be_answer =
      message.header.type == Type::kReply ||
      (message.header.type == Type::kControl && message.header.identifier != 0);
  if (!may_be_answer || !calls_.complete(message, memory)) host_.deliver(*this, message);
}

/// Before its body is gathered: whom it is for, and whether its sender may. An answer that nobody
/// waits for is dropped.
bool Link::admits(const Message& first) {
  const Header& header = first.header;
  const bool may_be_answer =
      header.type == Type::kReply || (header.type == Type::kControl && header.identifier != 0);
  if (may_be_answer) {
    return calls_.has(header.identifier);
  }
  const auto refusal = host_.refusal_of(*this, first, connection_->identity());
  if (refusal) refuse_locked(refusal->code, first, refusal->text);
  return !refusal;
}

void Link::arrived(std::size_t size) {
  assembler_.received(size);
  signs_of_life_.fetch_add(1, std::memory_order_relaxed);
}

std::optional<std::uint64_t> Link::incomplete() const {
  const std::lock_guard lock(mutex_);
  return open() ? assembler_.incomplete() : std::nullopt;
}

void Link::receive_once(base::Duration limit, std::unique_lock<std::mutex>& lock) {
  std::span<std::byte> room;
  if (!reserves([&] { room = assembler_.room(); })) return;
  std::size_t size = 0;
  lock.unlock();
  const Progress progress = connection_->wait_and_receive(room, size, limit);
  lock.lock();
  if (progress == Progress::kGone) return break_off_locked(connection_->problem());
  if (progress != Progress::kDone) return;
  arrived(size);
  reserves([&] { take_messages(); });
}

bool Link::take_reading() {
  if (!open() || reading_.is_of_caller()) return false;
  reading_.give_to_caller();
  update_interest();
  if (!reading_.listens()) return_later();
  return true;
}

/// Has the node take reading back soon.
void Link::return_later() {
  if (reading_.returns()) return;
  host_.return_soon(*this);
  reading_.begin_return();
}

/// Another caller who waits goes on reading; otherwise the node does, at once or later.
void Link::leave_reading() {
  WaitingCall* const next = calls_.first_waiting();
  if (next != nullptr && open()) {
    next->promoted = true;
    next->notify();
    return;
  }
  if (reading_.listens() || !open()) {
    reading_.give_to_node();
  } else {
    reading_.give_to_nobody();
    return_later();  // it may have listened until now
  }
  update_interest();
  if (!open()) host_.attend(*this);
}

// ---- Calls

void Link::call(Number operation, const Recipient& recipient, const CallOptions& options,
                const Fields& parameters, WaitingCall& call) {
  const base::Time deadline = base::later(platform::monotonic_now(), options.deadline);
  std::unique_lock lock(mutex_);
  const auto identifier = recipient.identifier();
  if (!open() || !identifier) {
    return call.refused(Code::kNotConnected, "it is not connected");
  }
  call.waits = true;
  calls_.add(call);
  const Sent sent = send_locked(options.priority, Type::kRequest, *identifier, {operation, call.id},
                                parameters, Flush::kNow);
  if (sent == Sent::kQueueFull) {
    calls_.remove(call.id);
    return call.refused(Code::kBusy, "the other side has not yet taken earlier messages");
  }
  bool reads = !call.done && take_reading();
  base::Duration limit = options.deadline;
  while (!call.done) {
    if (reads) {
      receive_once(limit, lock);
    } else {
      lock.unlock();
      call.wakeup.wait_until(deadline);
      lock.lock();
      reads = std::exchange(call.promoted, false);
    }
    if (call.done) break;
    limit = deadline - platform::monotonic_now();
    if (limit <= base::Duration::zero()) {
      calls_.remove(call.id);
      call.refused(Code::kDeadline, "no answer came before the deadline");
    }
  }
  if (reads || call.promoted) leave_reading();
}

void Link::call(Number operation, Priority priority, const Recipient& recipient,
                const Fields& parameters, std::unique_ptr<CallbackCall> call) {
  const std::lock_guard lock(mutex_);
  OpenCall* const open_call = call.release();
  const auto identifier = recipient.identifier();
  if (!open() || !identifier) {
    return open_call->refused(Code::kNotConnected, "it is not connected");
  }
  calls_.add(*open_call);
  const Sent sent = send_locked(priority, Type::kRequest, *identifier, {operation, open_call->id},
                                parameters, Flush::kNow);
  if (sent != Sent::kQueueFull) return;
  calls_.remove(open_call->id);
  open_call->refused(Code::kBusy, "the other side has not yet taken earlier messages");
}

}  // namespace armature::ride::internal
