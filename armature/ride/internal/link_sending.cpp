// SPDX-License-Identifier: Apache-2.0
// Of Link: what is sent, and calls.
#include <algorithm>
#include <new>
#include <tuple>
#include <utility>

#include "armature/platform/clock.hpp"
#include "armature/ride/internal/link.hpp"

namespace armature::ride::internal {
namespace {

/// A message that comes so soon after another waits for those that follow.
constexpr base::Duration kMoment = std::chrono::microseconds(20);
/// So much is sent by the one who gathers.
constexpr std::size_t kMostGathered = 8 * 1024;
/// What one large message took is given back.
constexpr std::size_t kMostKept = 256 * 1024;

}  // namespace

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
  if (unsent() < limits_.unsent_bytes + limits_.body_bytes) return false;
  break_off_locked("it does not read what it is sent");
  return true;
}

bool Link::is_backed_up() const { return blocked_ && unsent() >= limits_.unsent_bytes; }

Sent Link::send_locked(Priority priority, Type type, std::uint32_t recipient,
                       std::initializer_list<std::uint32_t> head, const Fields& fields,
                       Flush flush) {
  if (too_much_for(type)) return open() ? Sent::kQueueFull : Sent::kNotConnected;
  const bool appended = append([&] {
    const std::size_t start = out_.size();
    out_.extend(Header::kSize);
    Encoder body(out_);
    for (const std::uint32_t word : head) body.put(word);
    fields.put(body);
    finish_message(out_, start, priority, type, recipient);
  });
  if (!appended) return no_memory_for(type, recipient);
  if (flush == Flush::kNow) {
    send_out();
  } else {
    gather(platform::monotonic_now());
  }
  return open() ? Sent::kYes : Sent::kNotConnected;
}

/// All of it or nothing: false if not enough memory for it.
template <typename Append>
bool Link::append(const Append& append) {
  const std::size_t start = out_.size();
  try {
    append();
    return true;
  } catch (const std::bad_alloc&) {
    out_.truncate(start);
    out_.shrink(kMostKept);
    return false;
  }
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
  if (blocked_) return update_interest();
  transmit();
}

/// Sends what was appended, or has it wait for what follows.
void Link::gather(base::Time now) {
  if (blocked_) return update_interest();
  const bool alone = !flush_due_ && now - last_sent_ >= kMoment;
  if (alone || unsent() >= kMostGathered) {
    transmit();
    last_sent_ = now;
    gathered_since_ = now;
    return;
  }
  if (flush_due_) return;
  flush_due_ = true;
  gathered_since_ = now;
  host_.flush_soon(*this);
}

void Link::transmit() {
  const std::size_t before = sent_;
  while (sent_ < out_.size()) {
    std::size_t sent = 0;
    const Progress progress = connection_->send(out_.bytes().subspan(sent_), sent);
    if (progress == Progress::kGone) return break_off_locked(connection_->problem());
    if (progress != Progress::kDone) {
      if (before != sent_ || stuck_since_ == base::Time{}) stuck_since_ = platform::monotonic_now();
      blocked_ = true;
      update_interest();
      break;
    }
    sent_ += sent;
  }
  if (sent_ == out_.size()) stuck_since_ = {};
  forget_sent();
}

/// What is left is moved seldom: the other side may take much in small pieces.
void Link::forget_sent() {
  if (sent_ != out_.size() && sent_ < out_.size() / 2) return;
  out_.erase_front(std::exchange(sent_, 0));
  out_.shrink(kMostKept);
}

void Link::end_if_stuck(base::Time now, base::Duration limit) {
  const std::lock_guard lock(mutex_);
  if (!open() || !blocked_ || !memory->exceeds_reserve()) return;
  if (stuck_since_ != base::Time{} && now - stuck_since_ >= limit) {
    break_off_locked("it does not read what it is sent, and other connections need the memory");
  }
}

void Link::lose_event(const EventQueue& queue) {
  const std::lock_guard lock(mutex_);
  host_.event_dropped(queue);
}

void Link::send_event(EventQueue& queue, std::span<const std::byte> message, base::Time now) {
  const std::lock_guard lock(mutex_);
  if (!open()) return;
  if (!blocked_) {
    if (append_event(queue, message)) return gather(now);
    return host_.event_dropped(queue);
  }
  if (!queue.push(message)) host_.event_dropped(queue);
}

/// The subscriber's identifier goes into the header of each part.
/// @return false if not enough memory for it
bool Link::append_event(EventQueue& queue, std::span<const std::byte> message) {
  const std::size_t start = out_.size();
  if (!append([&] { out_.append(message); })) return false;
  for (std::size_t at = start; at < out_.size();) {
    std::byte* const header = out_.data() + at;
    store(header + 12, queue.subscription);
    at += load<std::uint16_t>(header + 10);
  }
  return true;
}

void Link::drain_event_queues() {
  for (const auto& queue : event_queues) {
    while (open() && !blocked_ && !queue->empty()) {
      if (!append_event(*queue, queue->front())) host_.event_dropped(*queue);
      queue->pop();
      transmit();
    }
  }
}

void Link::call(Number operation, const Recipient& recipient, const CallOptions& options,
                const Fields& parameters, WaitingCall& call) {
  const base::Time deadline = base::later(platform::monotonic_now(), options.deadline);
  std::unique_lock lock(mutex_);
  const auto identifier = recipient.identifier();
  if (!open() || !identifier) {
    return call.refused(Code::kNotConnected, "it is not connected");
  }
  call.id = ++last_call_ != 0 ? last_call_ : ++last_call_;
  call.waits = true;
  calls_.push_back(&call);
  const Sent sent = send_locked(options.priority, Type::kRequest, *identifier, {operation, call.id},
                                parameters, Flush::kNow);
  if (sent == Sent::kQueueFull) {
    remove_call(call.id);
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
      remove_call(call.id);
      call.refused(Code::kDeadline, "no answer came before the deadline");
    }
  }
  if (reads || call.promoted) leave_reading();
}

void Link::call(Number operation, const Recipient& recipient, const Fields& parameters,
                std::unique_ptr<CallbackCall> call) {
  constexpr Priority kMostUrgent{255};
  const std::lock_guard lock(mutex_);
  OpenCall* const open_call = call.release();
  const auto identifier = recipient.identifier();
  if (!open() || !identifier) {
    return open_call->refused(Code::kNotConnected, "it is not connected");
  }
  open_call->id = ++last_call_ != 0 ? last_call_ : ++last_call_;
  calls_.push_back(open_call);
  const Sent sent = send_locked(kMostUrgent, Type::kRequest, *identifier,
                                {operation, open_call->id}, parameters, Flush::kNow);
  if (sent != Sent::kQueueFull) return;
  remove_call(open_call->id);
  open_call->refused(Code::kBusy, "the other side has not yet taken earlier messages");
}

}  // namespace armature::ride::internal
