// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/internal/link.hpp"

#include <algorithm>
#include <utility>

#include "armature/platform/clock.hpp"

namespace armature::ride::internal {

Link::Link(LinkHost& host, platform::Poller& poller, const Limits& limits)
    : host_(host), poller_(poller), limits_(limits), assembler_(limits.body_bytes) {}

void Link::begin(std::unique_ptr<Connection> connection) {
  const std::lock_guard lock(mutex_);
  connection_ = std::move(connection);
  connections_.fetch_add(1, std::memory_order_relaxed);
  problem_.clear();
  establishing_ = Progress::kWantWrite;
  interest_ = {.write = true};
  reader_ = Reader::kIo;
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

std::optional<std::uint64_t> Link::read(std::size_t& size) {
  const std::lock_guard lock(mutex_);
  if (!open() || reader_ == Reader::kCaller) return std::nullopt;
  if (reader_ == Reader::kNobody) {
    reader_ = Reader::kIo;
    update_interest();
  }
  const std::span<std::byte> room = assembler_.room();
  const Progress progress = connection_->receive(room, size);
  if (progress == Progress::kGone) break_off_locked(connection_->problem());
  if (progress == Progress::kDone) {
    assembler_.received(size);
    take_messages();
  }
  if (progress == Progress::kWantWrite) {
    reading_waits_ = true;
    update_interest();
  }
  if (progress != Progress::kDone || size == room.size()) look_again_locked();
  return open() ? assembler_.incomplete() : std::nullopt;
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
  if (std::exchange(blocked_, false)) {
    transmit();
    drain_event_queues();
  }
  update_interest();
  return has_waited && interest_.read;
}

bool Link::flush(base::Time now, base::Duration age) {
  const std::lock_guard lock(mutex_);
  if (!open() || out_.empty() || blocked_) {
    flush_due_ = false;
    return false;
  }
  if (now - gathered_since_ >= age) transmit();
  return true;
}

bool Link::take_back() {
  const std::lock_guard lock(mutex_);
  if (reader_ == Reader::kNobody && takeovers_ == takeovers_seen_) {
    reader_ = Reader::kIo;
    update_interest();
  }
  takeovers_seen_ = takeovers_;
  return reader_ == Reader::kIo;
}

bool Link::ended() const {
  const std::lock_guard lock(mutex_);
  return connection_ != nullptr && !problem_.empty();
}

bool Link::close() {
  const std::lock_guard lock(mutex_);
  if (reader_ == Reader::kCaller || held_) return false;
  connection_.reset();
  assembler_.reset();
  out_.clear();
  blocked_ = false;
  reading_waits_ = false;
  flush_due_ = false;
  establishing_ = Progress::kDone;
  reader_ = Reader::kIo;
  event_queues.clear();
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
  listens_ = listens;
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
  for (OpenCall* const call : std::exchange(calls_, {})) {
    call->refused(Code::kConnectionLost, why);
  }
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
        refuse_locked(Code::kTooLarge, message, "the body is larger than this node takes");
        break;
      case Found::kBadMagic:
        return end_with(Code::kBadMagic, {}, "what came is no message: no 'RIDE'");
      case Found::kBadLength:
        return end_with(Code::kMalformed, message, "a length below that of the header");
      case Found::kTooMany:
        return end_with(Code::kTooLarge, message, "too many bodies go on at once");
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

/// False if no call is open that it answers.
bool Link::complete(const Message& message) {
  if (message.header.type == Type::kReply) {
    OpenCall* const call = remove_call(message.header.identifier);
    if (call != nullptr) call->answered(message.body);
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

void Link::receive_once(base::Duration limit, std::unique_lock<std::mutex>& lock) {
  const std::span<std::byte> room = assembler_.room();
  std::size_t size = 0;
  lock.unlock();
  const Progress progress = connection_->wait_and_receive(room, size, limit);
  lock.lock();
  if (progress == Progress::kGone) return break_off_locked(connection_->problem());
  if (progress != Progress::kDone) return;
  assembler_.received(size);
  take_messages();
}

bool Link::take_reading() {
  if (!open() || reader_ == Reader::kCaller) return false;
  ++takeovers_;
  const bool was_the_nodes = reader_ == Reader::kIo;
  reader_ = Reader::kCaller;
  update_interest();
  if (was_the_nodes && !listens_) host_.return_soon(*this);
  return true;
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
  update_interest();
  if (!open()) host_.attend(*this);
}

platform::Interest Link::wanted() const {
  const bool flows = establishing_ == Progress::kDone;
  const bool takes_nothing = peer == nullptr && is_backed_up();
  const bool reads = reader_ == Reader::kIo && !throttled && !takes_nothing && !reading_waits_;
  return {flows ? reads : establishing_ == Progress::kWantRead,
          flows ? blocked_ || reading_waits_ : establishing_ == Progress::kWantWrite,
          flows && connection_->takes_all()};
}

void Link::update_interest() {
  if (!connection_ || !problem_.empty() || held_) return;
  const platform::Interest now = wanted();
  if (now.read == interest_.read && now.write == interest_.write) return;
  interest_ = now;
  poller_.change(connection_->handle(), reinterpret_cast<std::uintptr_t>(this), now);
}

}  // namespace armature::ride::internal
