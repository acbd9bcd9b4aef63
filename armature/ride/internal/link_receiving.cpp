// SPDX-License-Identifier: Apache-2.0
// Of Link: what is received, and who reads it.
#include <algorithm>
#include <new>
#include <utility>

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
  if (!open() || reader_ == Reader::kCaller || is_leaving()) return std::nullopt;
  if (reader_ == Reader::kNobody) {
    reader_ = Reader::kIo;
    update_interest();
  }
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
  if (reader_ == Reader::kNobody && takeovers_ == takeovers_seen_) {
    reader_ = Reader::kIo;
    update_interest();
  }
  takeovers_seen_ = takeovers_;
  returns_ = reader_ != Reader::kIo;
  return !returns_;
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
  if (!may_be_answer || !complete(message)) host_.deliver(*this, message);
}

void Link::answer(OpenCall& call, std::span<const std::byte> result) {
  Holding holding(memory);
  try {
    call.answered(result, holding);
  } catch (const std::bad_alloc&) {
    call.refused(Code::kTooLarge, "not enough memory for the answer");
  }
}

/// Before its body is gathered: whom it is for, and whether its sender may. An answer that nobody
/// waits for is dropped.
bool Link::admits(const Message& first) {
  const Header& header = first.header;
  const bool may_be_answer =
      header.type == Type::kReply || (header.type == Type::kControl && header.identifier != 0);
  if (may_be_answer) {
    return std::ranges::find(calls_, header.identifier, &OpenCall::id) != calls_.end();
  }
  const auto refusal = host_.refusal_of(*this, first, connection_->identity());
  if (refusal) refuse_locked(refusal->code, first, refusal->text);
  return !refusal;
}

/// False if no call is open that it answers.
bool Link::complete(const Message& message) {
  if (message.header.type == Type::kReply) {
    OpenCall* const call = remove_call(message.header.identifier);
    if (call != nullptr) answer(*call, message.body);
    return call != nullptr;
  }
  Decoder from(message.body);
  Control control;
  if (!from.take(control) || !from.ended()) return false;
  OpenCall* const call = remove_call(message.header.identifier);
  if (call != nullptr) call->refused(control.code, control.text);
  return call != nullptr;
}

OpenCall* Link::remove_call(std::uint32_t id) {
  const auto at = std::ranges::find(calls_, id, &OpenCall::id);
  if (at == calls_.end()) return nullptr;
  OpenCall* const call = *at;
  calls_.erase(at);
  return call;
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
  if (!open() || reader_ == Reader::kCaller) return false;
  ++takeovers_;
  reader_ = Reader::kCaller;
  update_interest();
  if (!listens_) return_later();
  return true;
}

/// Has the node take reading back soon.
void Link::return_later() {
  if (returns_) return;
  host_.return_soon(*this);
  returns_ = true;
}

/// Another caller who waits goes on reading; otherwise the node does, at once or later.
void Link::leave_reading() {
  const auto next = std::ranges::find_if(calls_, [](const OpenCall* call) { return call->waits; });
  if (next != calls_.end() && open()) {
    auto* const call = static_cast<WaitingCall*>(*next);
    call->promoted = true;
    call->notify();
    return;
  }
  reader_ = listens_ || !open() ? Reader::kIo : Reader::kNobody;
  if (reader_ == Reader::kNobody) return_later();  // it may have listened until now
  update_interest();
  if (!open()) host_.attend(*this);
}

}  // namespace armature::ride::internal
