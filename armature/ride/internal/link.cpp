// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/internal/link.hpp"

#include <utility>

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

void Link::let_go_if_leaving() {
  if (!is_leaving() || !waiting.empty()) return;
  const std::lock_guard lock(mutex_);
  if (!open() || unsent() != 0 || kept_replies.load(std::memory_order_relaxed) != 0) return;
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
  if (std::exchange(blocked_, false)) {
    signs_of_life_.fetch_add(1, std::memory_order_relaxed);
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
  out_.shrink(0);
  sent_ = 0;
  blocked_ = false;
  reading_waits_ = false;
  flush_due_ = false;
  establishing_ = Progress::kDone;
  reader_ = Reader::kIo;
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

platform::Interest Link::wanted() const {
  const bool flows = establishing_ == Progress::kDone;
  const bool takes_nothing = peer == nullptr && is_backed_up();
  const bool reads =
      reader_ == Reader::kIo && !throttled && !takes_nothing && !reading_waits_ && !is_leaving();
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
